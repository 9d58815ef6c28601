#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "bench/timed_drawing.hpp"

namespace burin::host::bench {

/// One row of skip.csv: one scene with skipping on or off.
struct SkipMeasurement {
  std::string scene;
  double visibleFraction = 0;  ///< voxels that some layer shows / all voxels
  bool isSkipping = true;
  int repeats = 0;
  double medianMs = 0, smallestMs = 0, largestMs = 0;  ///< the slowest rank's drawing
  /// Of all ranks, from a frame that is not timed.
  std::int64_t samplesVisited = 0, samplesShaded = 0, samplesInOccupiedCells = 0, leaps = 0;
  /// medianMs / the dense scene's in the same rounds; 0 without a dense scene.
  double ratioToDense = 0;
  /// What changing the transfer functions adds to the frame after it, median; < 0: not measured.
  double editMs = -1;
};

/// Collective over `comm`. Draws one scene with skipping on and off and, if given, the dense scene
/// (every voxel visible, the same size and frame), `repeats` times each, all in turns, so that what
/// else the machine does meets them alike; before that once each to warm up, and once to count
/// samples. With skipping on, the transfer functions are also edited, to and fro, as often. On and
/// off, in this order.
std::array<SkipMeasurement, 2> measureSkip(const Communicator& comm, const std::string& name,
                                           PreparedScene& prepared, TimedDrawing* dense,
                                           int repeats);

}  // namespace burin::host::bench
