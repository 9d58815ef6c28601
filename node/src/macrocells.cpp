#include "macrocells.hpp"

#include <algorithm>
#include <limits>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

int floorDivide(int a, int b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

/// Local macrocell range [first, last] that voxel `v` belongs to along one axis.
struct Span {
  int first, last;
};
Span cellsOfVoxel(int v, int firstCell, int size) {
  const int cell = floorDivide(v, kMacrocellSize);
  const int before = v == cell * kMacrocellSize ? cell - 1 : cell;
  return {std::max(before - firstCell, 0), std::min(cell - firstCell, size - 1)};
}

}  // namespace

Macrocells::Macrocells(const IndexBox& storedVoxels) {
  for (int axis = 0; axis < 3; ++axis) {
    firstCell_[axis] = floorDivide(storedVoxels.lo[axis], kMacrocellSize);
    // The last voxel alone opens no macrocell unless it is the only one.
    const int lastCell = std::max(storedVoxels.hi[axis] - 2, storedVoxels.lo[axis]);
    size_[axis] = floorDivide(lastCell, kMacrocellSize) - firstCell_[axis] + 1;
  }
  ranges_ = ValueRanges{size_};
}

std::size_t Macrocells::index(int x, int y, int z) const {
  return (static_cast<std::size_t>(z) * static_cast<std::size_t>(size_.y) +
          static_cast<std::size_t>(y)) *
             static_cast<std::size_t>(size_.x) +
         static_cast<std::size_t>(x);
}

void Macrocells::add(const IndexBox& box, std::span<const float> stored) {
  BURIN_CHECK_EQ(stored.size(), box.count());
  const auto width = static_cast<std::size_t>(box.size().x);
  std::vector<float> rowLowest(static_cast<std::size_t>(size_.x));
  std::vector<float> rowHighest(static_cast<std::size_t>(size_.x));
  const float* row = stored.data();
  for (int z = box.lo.z; z < box.hi.z; ++z) {
    const Span cz = cellsOfVoxel(z, firstCell_.z, size_.z);
    for (int y = box.lo.y; y < box.hi.y; ++y, row += width) {
      const Span cy = cellsOfVoxel(y, firstCell_.y, size_.y);
      for (int cx = 0; cx < size_.x; ++cx) {
        const int begin = std::max((firstCell_.x + cx) * kMacrocellSize, box.lo.x);
        const int end = std::min((firstCell_.x + cx + 1) * kMacrocellSize + 1, box.hi.x);
        float lowest = kInfinity;
        float highest = -kInfinity;
        for (int x = begin; x < end; ++x) {
          const float v = row[x - box.lo.x];
          lowest = v < lowest ? v : lowest;  // comparisons with NaN are false
          highest = v > highest ? v : highest;
        }
        rowLowest[static_cast<std::size_t>(cx)] = lowest;
        rowHighest[static_cast<std::size_t>(cx)] = highest;
      }
      for (int k = cz.first; k <= cz.last; ++k)
        for (int j = cy.first; j <= cy.last; ++j) {
          const std::size_t first = index(0, j, k);
          for (std::size_t i = 0; i < rowLowest.size(); ++i) {
            ranges_.lowest[first + i] = std::min(ranges_.lowest[first + i], rowLowest[i]);
            ranges_.highest[first + i] = std::max(ranges_.highest[first + i], rowHighest[i]);
          }
        }
    }
  }
}

IndexBox Macrocells::boxOf(std::span<const std::uint8_t> marks) const {
  glm::ivec3 lo = size_;
  glm::ivec3 hi{0};
  std::size_t i = 0;
  for (int z = 0; z < size_.z; ++z)
    for (int y = 0; y < size_.y; ++y)
      for (int x = 0; x < size_.x; ++x, ++i) {
        if (marks[i] == 0) continue;
        lo = glm::min(lo, glm::ivec3{x, y, z});
        hi = glm::max(hi, glm::ivec3{x, y, z} + 1);
      }
  if (hi.x <= lo.x) return {};
  return {kMacrocellSize * (firstCell_ + lo), kMacrocellSize * (firstCell_ + hi)};
}

}  // namespace burin::node
