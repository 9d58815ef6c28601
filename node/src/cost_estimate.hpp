#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burin/common/geometry.hpp"
#include "clip_planes.hpp"

namespace burin::node {

/// Estimated cost of drawing a box of cells, from what the survey's blocks may show: cells of a
/// marked block cost 1, others kEmptyCost; spread evenly in a block, so that the estimate is
/// additive over disjoint boxes.
class CostEstimate {
 public:
  /// What an empty cell costs against a visible one: rays leap over it, but not for nothing.
  static constexpr double kEmptyCost = 0.02;

  /// `marks`: VisibleBlocks::mark().
  CostEstimate(std::span<const std::uint8_t> marks, const CubeGrid& blocks, const VolumeGrid& grid);

  double operator()(const IndexBox& cells) const;

 private:
  double below(const glm::ivec3& corner) const;  ///< cost of all cells below the corner
  double sumAt(const glm::ivec3& block) const;

  glm::ivec3 cells_;
  glm::ivec3 blocks_;
  int blockCells_;
  std::vector<double> sums_;  ///< summed-volume table, (blocks + 1)³, x fastest
};

}  // namespace burin::node
