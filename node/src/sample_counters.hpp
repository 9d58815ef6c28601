#pragma once

#include <optional>

#include "burin/common/geometry.hpp"
#include "burin/common/image.hpp"
#include "burin/common/statistics.hpp"
#include "gl.hpp"

namespace burin::node {

/// The sample counters that programs with COUNT_SAMPLES add to, 32 bits each. Its OffscreenContext
/// must be current.
class SampleCounters {
 public:
  SampleCounters();

  /// Sets them to 0 for the draws that follow.
  void begin();
  /// Adds what was counted since.
  void addTo(RankStatistics& statistics);

 private:
  Buffer buffer_;
};

/// Draws the full-screen triangle in `pixels`, counting if there are counters: in bands of rows, as
/// these are 32 bits wide. `samples`: of a ray, at most.
void drawFullscreen(std::optional<SampleCounters>& counters, const PixelRect& pixels,
                    double samples, RankStatistics& statistics);

/// Lattice planes that a ray crosses in the volume, at most.
double mostPlanes(const VolumeGrid& grid, double stepVoxels);

}  // namespace burin::node
