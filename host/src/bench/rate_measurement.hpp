#pragma once

#include <cstdint>
#include <string>

#include "bench/rate_scenes.hpp"
#include "bench/timed_drawing.hpp"

namespace burin::host::bench {

/// Frames of one scene and what it took to draw them.
struct FrameRate {
  /// Of one frame that is not timed, over all ranks.
  std::int64_t samplesVisited = 0, samplesShaded = 0, samplesInOccupiedCells = 0, leaps = 0;
  std::int64_t pixels = 0;
  double medianMs = 0, smallestMs = 0, largestMs = 0;  ///< the slowest rank's drawing

  double samplesPerSecond() const { return 1e3 * static_cast<double>(samplesVisited) / medianMs; }
};

/// One row of rates.csv: a scene drawn in one way, and the same program with all lanes busy.
struct RateMeasurement {
  std::string scene;
  Look look = Look::kOpaque;
  Shading shading = Shading::kPlain;
  int repeats = 0;
  FrameRate frame;
  FrameRate busy;  ///< withAllLanesBusy(), skipping off
  /// Samples per second of `frame` over those of `busy` in the same round: the median over rounds.
  double ratio = 0;
};

/// Collective over `comm`. Draws `prepared` in that way and its program with all lanes busy,
/// `repeats` times each in turns, so that what else the machine does meets them alike; before that
/// once each to count samples and once each to warm up.
RateMeasurement measureRate(const Communicator& comm, const std::string& name,
                            PreparedScene& prepared, Look look, Shading shading, int repeats);

}  // namespace burin::host::bench
