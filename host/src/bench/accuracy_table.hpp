#pragma once

#include <span>
#include <string>

#include "bench/accuracy_measurement.hpp"

namespace burin::host::bench {

/// accuracy.csv: a header line and a line per measurement; step_voxels is 0 where the step was
/// chosen, max_error_asked where it was not; `pareto` is 1 where nothing else of the
/// scene is both faster and more accurate.
std::string accuracyCsv(std::span<const AccuracyMeasurement> rows);

/// The table for people, and how asked and measured errors compare.
std::string accuracySummary(std::span<const AccuracyMeasurement> rows);

/// gnuplot script: per scene error against time and against samples, the Pareto front as a line.
std::string accuracyPlots(std::span<const AccuracyMeasurement> rows);

/// Whether no row of the same scene is faster with an error at most as large.
bool isOnFront(const AccuracyMeasurement& row, std::span<const AccuracyMeasurement> rows);

}  // namespace burin::host::bench
