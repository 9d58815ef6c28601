#pragma once

#include <span>
#include <string>

#include "bench/skip_measurement.hpp"

namespace burin::host::bench {

/// Names that the table and the plots know: one ball, kManyBalls of them, every voxel visible.
inline constexpr const char* kBall = "ball";
inline constexpr const char* kBalls = "balls";
inline constexpr const char* kDense = "dense";
inline constexpr int kManyBalls = 30;

/// skip.csv: a header line and a line per measurement.
std::string skipCsv(std::span<const SkipMeasurement> rows);

/// One line for a scene, with skipping on and off.
std::string skipLine(const SkipMeasurement& on, const SkipMeasurement& off);

/// How the measurements stand to the targets: one ball of 1 % of the voxels and kManyBalls of them
/// against the dense scene's time, visited samples against those in occupied cells and against
/// shaded ones (the worst scene with skipping). Lines whose measurements are missing are left out.
std::string skipTargets(std::span<const SkipMeasurement> rows);

/// A gnuplot script that draws skip.png from the skip.csv beside it: time and visited samples
/// against the visible fraction, both logarithmic, skipping on (thick) and off (dashed).
std::string skipPlots(std::span<const SkipMeasurement> rows);

}  // namespace burin::host::bench
