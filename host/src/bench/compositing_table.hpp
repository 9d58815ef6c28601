#pragma once

#include <span>
#include <string>
#include <string_view>

#include "bench/compositing_measurement.hpp"

namespace burin::host::bench {

/// compositing.csv: a header line and a line per measurement. `network`: how the ranks were joined,
/// "shm" or the link's name.
std::string compositingCsv(std::span<const CompositingMeasurement> rows, std::string_view network);

/// One line for the measurements of one input: burin's fastest schedule and IceT's.
std::string caseLine(std::span<const CompositingMeasurement> rows);

/// The comparison in numbers: per kind of input and burin's schedule the geometric means, over all
/// inputs and rank counts, of burin's figure / IceT's best (below 1: burin is better), and the
/// worst case, once against its single-image strategies and once against all; then what rank counts
/// between powers of two cost, against the interpolation of their neighbours, linear in the
/// logarithm of the count. The first two parts are missing without IceT.
std::string compositingSummary(std::span<const CompositingMeasurement> rows);

}  // namespace burin::host::bench
