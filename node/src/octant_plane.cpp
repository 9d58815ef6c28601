#include "octant_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burin::node {
namespace {

/// A look-up at a position that rounds across a face (by at most 2048 * 2^-23 voxel in the texture
/// unit), or oversteps it as a leap may (exitMargin in skip.glsl), reads a value outside of the
/// range by no more than this part of the difference to the neighbours'.
constexpr float kWidening = 0x1p-8f;

// Loops with nothing but local variables, so that the compiler vectorises them.
void takeSmaller(const float* from, float* to, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) to[i] = from[i] < to[i] ? from[i] : to[i];
}
void takeLarger(const float* from, float* to, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) to[i] = from[i] > to[i] ? from[i] : to[i];
}

/// `own` to `own` minus 2^-8 of its difference to the extreme of `around` there and at the
/// neighbours along the row, by `take`. Infinite ones stay.
template <typename Take>
void widen(const float* own, const std::vector<float>& around, std::vector<float>& row, Take take) {
  constexpr float kMost = std::numeric_limits<float>::max();
  const std::size_t last = around.size() - 1;
  row = around;
  take(around.data() + 1, row.data(), last);
  take(around.data(), row.data() + 1, last);
  for (std::size_t i = 0; i <= last; ++i) {
    const float widened = own[i] - kWidening * (own[i] - row[i]);
    row[i] = std::abs(own[i]) <= kMost ? widened : own[i];
  }
}

}  // namespace

OctantPlane::OctantPlane(const glm::ivec2& octants)
    : width_{static_cast<std::size_t>(octants.x)}, rows_{octants.y} {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const std::size_t count = width_ * static_cast<std::size_t>(rows_);
  lowest_.assign(count, kInfinity);
  highest_.assign(count, -kInfinity);
}

void OctantPlane::add(int y, const OctantRow& voxels) {
  const std::size_t first = static_cast<std::size_t>(y) * width_;
  takeSmaller(voxels.lowest.data(), lowest_.data() + first, width_);
  takeLarger(voxels.highest.data(), highest_.data() + first, width_);
}

/// Widens a row of ranges to hold those of the octants (·, y) and of their neighbours along y.
void OctantPlane::takeRow(int y, OctantRow& row) const {
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, rows_ - 1); ++j) {
    const std::size_t first = static_cast<std::size_t>(j) * width_;
    takeSmaller(lowest_.data() + first, row.lowest.data(), width_);
    takeLarger(highest_.data() + first, row.highest.data(), width_);
  }
}

void OctantPlane::widenedRow(int y, const OctantPlane* before, const OctantPlane* behind,
                             OctantRow& row) const {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  OctantRow around{std::vector<float>(width_, kInfinity), std::vector<float>(width_, -kInfinity)};
  for (const OctantPlane* plane : {before, this, behind})
    if (plane != nullptr) plane->takeRow(y, around);
  const std::size_t first = static_cast<std::size_t>(y) * width_;
  widen(lowest_.data() + first, around.lowest, row.lowest, takeSmaller);
  widen(highest_.data() + first, around.highest, row.highest, takeLarger);
}

}  // namespace burin::node
