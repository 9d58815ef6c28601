#include "macrocells.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kWidening = 0x1p-8f;

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

/// Running minimum (or maximum) over ±1 along one axis of a grid.
template <typename Pick>
void spreadAxis(std::vector<float>& values, const glm::ivec3& size, int axis, Pick pick) {
  const std::array<std::size_t, 3> stride{
      1, static_cast<std::size_t>(size.x),
      static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y)};
  const std::vector<float> old = values;
  const std::size_t step = stride[static_cast<std::size_t>(axis)];
  std::size_t i = 0;
  glm::ivec3 at{0};
  for (at.z = 0; at.z < size.z; ++at.z)
    for (at.y = 0; at.y < size.y; ++at.y)
      for (at.x = 0; at.x < size.x; ++at.x, ++i) {
        if (at[axis] > 0) values[i] = pick(values[i], old[i - step]);
        if (at[axis] + 1 < size[axis]) values[i] = pick(values[i], old[i + step]);
      }
}

}  // namespace

Macrocells::Macrocells(const IndexBox& storedVoxels) {
  for (int axis = 0; axis < 3; ++axis) {
    firstCell_[axis] = floorDivide(storedVoxels.lo[axis], kMacrocellSize);
    // The last voxel alone opens no macrocell unless it is the only one.
    const int lastCell = std::max(storedVoxels.hi[axis] - 2, storedVoxels.lo[axis]);
    size_[axis] = floorDivide(lastCell, kMacrocellSize) - firstCell_[axis] + 1;
  }
  const std::size_t count = index(0, 0, size_.z);
  lowest_.assign(count, kInfinity);
  highest_.assign(count, -kInfinity);
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
            lowest_[first + i] = std::min(lowest_[first + i], rowLowest[i]);
            highest_[first + i] = std::max(highest_[first + i], rowHighest[i]);
          }
        }
    }
  }
}

void Macrocells::finish() {
  std::vector<float> lowestAround = lowest_;
  std::vector<float> highestAround = highest_;
  for (int axis = 0; axis < 3; ++axis) {
    spreadAxis(lowestAround, size_, axis, [](float a, float b) { return std::min(a, b); });
    spreadAxis(highestAround, size_, axis, [](float a, float b) { return std::max(a, b); });
  }
  for (std::size_t i = 0; i < lowest_.size(); ++i) {
    if (lowest_[i] > highest_[i]) continue;  // no finite voxel, shared faces included
    lowest_[i] -= kWidening * (lowest_[i] - lowestAround[i]);
    highest_[i] += kWidening * (highestAround[i] - highest_[i]);
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
