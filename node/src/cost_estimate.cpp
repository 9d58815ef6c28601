#include "cost_estimate.hpp"

#include <algorithm>

#include "burin/common/error.hpp"

namespace burin::node {

CostEstimate::CostEstimate(std::span<const float> cellCosts, const CubeGrid& blocks,
                           const VolumeGrid& grid)
    : cells_{grid.cells()}, blocks_{blocks.size}, blockCells_{blocks.cubeCells} {
  BURIN_CHECK_EQ(cellCosts.size(), (IndexBox{glm::ivec3{0}, blocks_}.count()));
  const glm::ivec3 size = blocks_ + 1;
  sums_.assign(IndexBox{glm::ivec3{0}, size}.count(), 0.0);
  const auto at = [&](int x, int y, int z) -> double& {
    return sums_[(static_cast<std::size_t>(z) * static_cast<std::size_t>(size.y) +
                  static_cast<std::size_t>(y)) *
                     static_cast<std::size_t>(size.x) +
                 static_cast<std::size_t>(x)];
  };
  std::size_t i = 0;
  for (int z = 0; z < blocks_.z; ++z)
    for (int y = 0; y < blocks_.y; ++y)
      for (int x = 0; x < blocks_.x; ++x, ++i) {
        const glm::ivec3 block{x, y, z};
        const glm::dvec3 extent = glm::min(cells_ - blockCells_ * block, glm::ivec3{blockCells_});
        const double cost = extent.x * extent.y * extent.z * double{cellCosts[i]};
        at(x + 1, y + 1, z + 1) = cost + at(x, y + 1, z + 1) + at(x + 1, y, z + 1) +
                                  at(x + 1, y + 1, z) - at(x, y, z + 1) - at(x, y + 1, z) -
                                  at(x + 1, y, z) + at(x, y, z);
      }
}

double CostEstimate::sumAt(const glm::ivec3& block) const {
  const glm::ivec3 size = blocks_ + 1;
  return sums_[(static_cast<std::size_t>(block.z) * static_cast<std::size_t>(size.y) +
                static_cast<std::size_t>(block.y)) *
                   static_cast<std::size_t>(size.x) +
               static_cast<std::size_t>(block.x)];
}

double CostEstimate::below(const glm::ivec3& corner) const {
  // Trilinear in the summed-volume table: constant density inside a block (the last one of an axis
  // may be shorter).
  glm::ivec3 block;
  glm::dvec3 part;
  for (int axis = 0; axis < 3; ++axis) {
    block[axis] = std::min(corner[axis] / blockCells_, blocks_[axis] - 1);
    const int extent = std::min(blockCells_, cells_[axis] - blockCells_ * block[axis]);
    part[axis] = static_cast<double>(corner[axis] - blockCells_ * block[axis]) / extent;
  }
  double sum = 0;
  for (int k = 0; k < 8; ++k) {
    const glm::ivec3 step{k & 1, (k >> 1) & 1, k >> 2};
    const glm::dvec3 w = glm::mix(1.0 - part, part, glm::dvec3{step});
    sum += w.x * w.y * w.z * sumAt(block + step);
  }
  return sum;
}

double CostEstimate::operator()(const IndexBox& cells) const {
  double sum = 0;
  for (int k = 0; k < 8; ++k) {
    const glm::bvec3 high{(k & 1) != 0, (k & 2) != 0, (k & 4) != 0};
    const glm::ivec3 corner{high.x ? cells.hi.x : cells.lo.x, high.y ? cells.hi.y : cells.lo.y,
                            high.z ? cells.hi.z : cells.lo.z};
    const int lows = (high.x ? 0 : 1) + (high.y ? 0 : 1) + (high.z ? 0 : 1);
    sum += (lows % 2 == 0 ? 1.0 : -1.0) * below(corner);
  }
  return std::max(sum, 0.0);
}

}  // namespace burin::node
