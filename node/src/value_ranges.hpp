#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace burin::node {

/// Smallest and largest stored value of each cube of a grid (the survey's blocks), faces shared, x
/// fastest; lowest > highest where a cube holds no finite voxel.
struct ValueRanges {
  glm::ivec3 size{0};
  std::vector<float> lowest;
  std::vector<float> highest;

  ValueRanges() = default;
  /// No values yet.
  explicit ValueRanges(const glm::ivec3& cubes);

  /// Per cube 1 if visible(lowest, highest) says so of its range.
  template <typename Visible>
  std::vector<std::uint8_t> mark(const Visible& visible) const {
    std::vector<std::uint8_t> marks(lowest.size());
    for (std::size_t i = 0; i < marks.size(); ++i)
      marks[i] = lowest[i] <= highest[i] && visible(lowest[i], highest[i]) ? 1 : 0;
    return marks;
  }

  std::size_t bytes() const { return (lowest.size() + highest.size()) * sizeof(float); }
};

}  // namespace burin::node
