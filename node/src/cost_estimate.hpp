#pragma once

#include <vector>

#include "burin/common/geometry.hpp"
#include "burin/common/scene.hpp"
#include "burin/node/survey.hpp"

namespace burin::node {

/// Estimated cost of drawing a box of cells, from the survey's blocks and the scene's transfer
/// functions: cells of a block that may show something cost 1, others kEmptyCost; spread evenly in
/// a block, so that the estimate is additive over disjoint boxes.
class CostEstimate {
 public:
  /// What an empty cell costs against a visible one: rays leap over it, but not for nothing.
  static constexpr double kEmptyCost = 0.02;

  CostEstimate(const BlockRanges& blocks, const VolumeGrid& grid, const Scene& scene);

  double operator()(const IndexBox& cells) const;

 private:
  double below(const glm::ivec3& corner) const;  ///< cost of all cells below the corner
  double sumAt(const glm::ivec3& block) const;

  glm::ivec3 cells_;
  glm::ivec3 blocks_;
  std::vector<double> sums_;  ///< summed-volume table, (blocks + 1)³, x fastest
};

}  // namespace burin::node
