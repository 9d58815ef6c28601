#include "dilated_marks.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

/// Of the cubes from `first` on, `stride` apart: marked where one of them is, no more than `reach`
/// away.
void dilateRow(std::span<std::uint8_t> marks, std::size_t first, std::size_t stride, int length,
               int reach) {
  int behind = reach + 1;  // cubes since the last marked one
  std::vector<std::uint8_t> row(static_cast<std::size_t>(length));
  for (int i = 0; i < length; ++i) {
    behind = marks[first + static_cast<std::size_t>(i) * stride] != 0 ? 0 : behind + 1;
    row[static_cast<std::size_t>(i)] = behind <= reach ? 1 : 0;
  }
  int ahead = reach + 1;
  for (int i = length - 1; i >= 0; --i) {
    std::uint8_t& mark = marks[first + static_cast<std::size_t>(i) * stride];
    ahead = mark != 0 ? 0 : ahead + 1;
    mark = ahead <= reach ? std::uint8_t{1} : row[static_cast<std::size_t>(i)];
  }
}

}  // namespace

void dilateMarks(std::vector<std::uint8_t>& marks, const glm::ivec3& size, int reach) {
  const auto extent = glm::vec<3, std::size_t>{size};
  BURIN_CHECK_EQ(marks.size(), extent.x * extent.y * extent.z);
  if (reach <= 0) return;
  const std::array<std::size_t, 3> stride{1, extent.x, extent.x * extent.y};
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < marks.size(); ++i) {
      const auto a = static_cast<std::size_t>(axis);
      if (i / stride[a] % extent[axis] == 0) dilateRow(marks, i, stride[a], size[axis], reach);
    }
}

}  // namespace burin::node
