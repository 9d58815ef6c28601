#pragma once

#include <span>
#include <string>

#include "bench/scaling_measurement.hpp"

namespace burin::host::bench {

/// scaling.csv: a header line and a line per measurement.
std::string scalingTableCsv(std::span<const ScalingMeasurement> rows);

/// One line for a measurement.
std::string scalingLine(const ScalingMeasurement& row);

/// How unevenly 8 ranks draw, slowest / mean of each scene that was measured so, and what the most
/// ranks gain: speed-up and share of the ideal for strong scaling, time against one rank's for
/// weak.
std::string scalingSummary(std::span<const ScalingMeasurement> rows);

/// A gnuplot script that draws scaling.png from the scaling.csv beside it: render (slowest and
/// mean), composite and frame time against ranks, a diagram for each of strong and weak scaling
/// that was measured; wall times dashed. Empty without either.
std::string scalingTablePlots(std::span<const ScalingMeasurement> rows);

}  // namespace burin::host::bench
