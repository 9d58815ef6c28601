#include "value_ranges.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "burin/common/geometry.hpp"

namespace burin::node {
namespace {

constexpr float kWidening = 0x1p-8f;

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

ValueRanges::ValueRanges(const glm::ivec3& cubes) : size{cubes} {
  const std::size_t count = IndexBox{glm::ivec3{0}, cubes}.count();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  lowest.assign(count, kInfinity);
  highest.assign(count, -kInfinity);
}

void ValueRanges::widen() {
  std::vector<float> lowestAround = lowest;
  std::vector<float> highestAround = highest;
  for (int axis = 0; axis < 3; ++axis) {
    spreadAxis(lowestAround, size, axis, [](float a, float b) { return std::min(a, b); });
    spreadAxis(highestAround, size, axis, [](float a, float b) { return std::max(a, b); });
  }
  for (std::size_t i = 0; i < lowest.size(); ++i) {
    if (lowest[i] > highest[i]) continue;  // no finite voxel, shared faces included
    lowest[i] -= kWidening * (lowest[i] - lowestAround[i]);
    highest[i] += kWidening * (highestAround[i] - highest[i]);
  }
}

}  // namespace burin::node
