#pragma once

#include <span>
#include <string>

#include "bench/rate_measurement.hpp"

namespace burin::host::bench {

/// rates.csv: a header line and a line per measurement.
std::string rateCsv(std::span<const RateMeasurement> rows);

/// One line of a measurement for people.
std::string rateLine(const RateMeasurement& row);

/// How the measurements stand to the targets, the worst of each look: the rate of samples against
/// that with all lanes busy, samples visited against those in occupied cells and shaded ones.
std::string rateTargets(std::span<const RateMeasurement> rows);

/// A gnuplot script that draws rates.png from the rates.csv beside it: the ratio of rates and
/// samples visited per shaded one, by scene, with their targets as lines. Every scene has a row for
/// each look and shading there, one after another.
std::string ratePlots(std::span<const RateMeasurement> rows);

}  // namespace burin::host::bench
