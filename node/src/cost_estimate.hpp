#pragma once

#include <span>
#include <vector>

#include "burin/common/geometry.hpp"
#include "clip_planes.hpp"

namespace burin::node {

/// Estimated cost of drawing a box of cells: the sum of its cells' costs, which are the same for
/// all cells of one of the survey's blocks, so that the estimate is additive over disjoint boxes.
class CostEstimate {
 public:
  /// `cellCosts`: of one cell of each block, finite and >= 0; x fastest.
  CostEstimate(std::span<const float> cellCosts, const CubeGrid& blocks, const VolumeGrid& grid);

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
