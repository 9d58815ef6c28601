#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burin/common/brick_tree.hpp"
#include "burin/common/camera.hpp"
#include "clip_planes.hpp"
#include "cost_estimate.hpp"

namespace burin::node {

/// What the cost of drawing is estimated from, the same on all ranks. The spans must stay.
struct DrawnBlocks {
  VolumeGrid grid;
  CubeGrid cubes;
  std::span<const std::uint8_t> marks;  ///< VisibleBlocks::mark()
  std::span<const Camera> views;        ///< empty: every cell is met by as many rays
  double stepVoxels = 1;
  double termination = 0;         ///< of rays; 0: nothing hides anything
  std::vector<float> extinction;  ///< VisibleBlocks::extinction(), if isHiding()

  /// Whether what is hidden from the views counts less.
  bool isHiding() const { return !views.empty() && termination > 0; }
};

/// Estimate of the rounds that rays' loops take in each cell, summed over the views: in visible
/// blocks samples, in empty ones leaps, the fewer the further away the visible ones are. A brick
/// holds voxels whether its views see them or not, so no visible cell counts less than a quarter of
/// their mean: no rank gets more than about four times its share of them.
class DrawingCost {
 public:
  explicit DrawingCost(DrawnBlocks blocks);

  /// If nothing hid anything.
  CostEstimate unhidden() const;
  /// With these bricks, each of which hides parts of itself.
  CostEstimate with(const BrickTree& tree) const;

  /// Whether with() differs from unhidden().
  bool isHiding() const { return blocks_.isHiding(); }

 private:
  CostEstimate estimate(std::vector<float> rays) const;

  DrawnBlocks blocks_;
  std::vector<std::vector<float>> rays_;  ///< per cell, of each view
};

}  // namespace burin::node
