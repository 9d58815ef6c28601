#include "macrocells.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kSides = 2;  ///< octants along each side of a macrocell
constexpr int kOctantSize = kMacrocellSize / kSides;

int floorDivide(int a, int b) {
  return a >= 0 ? a / b : -((-a + b - 1) / b);
}

/// Octants [first, last] along one axis that a voxel belongs to, counted from the first
/// macrocell's: two at a shared face.
struct Span {
  int first, last;
};
Span octantsOfVoxel(int voxelFromFirst, int macrocells) {
  const int octant = voxelFromFirst / kOctantSize;
  const int before = voxelFromFirst == octant * kOctantSize ? octant - 1 : octant;
  return {std::max(before, 0), std::min(octant, kSides * macrocells - 1)};
}

/// The extremes of a row's voxels, for each octant along x.
class RowExtremes {
 public:
  /// `begin`, `end`: of the row, from the first macrocell's first voxel.
  RowExtremes(int macrocells, int begin, int end)
      : begin_{static_cast<std::size_t>(begin)}, count_{static_cast<std::size_t>(end - begin)} {
    const std::size_t octants = kSides * static_cast<std::size_t>(macrocells);
    const std::size_t voxels = std::max(octants * kOctantSize + 1, begin_ + count_);
    low_.assign(voxels, kInfinity);
    high_.assign(voxels, -kInfinity);
    octants_.lowest.resize(octants);
    octants_.highest.resize(octants);
  }

  const OctantRow& of(const float* row) {
    float* const low = low_.data() + begin_;
    float* const high = high_.data() + begin_;
    for (std::size_t x = 0; x < count_; ++x) {
      const bool valid = row[x] == row[x];
      low[x] = valid ? row[x] : kInfinity;
      high[x] = valid ? row[x] : -kInfinity;
    }
    for (std::size_t i = 0; i < octants_.lowest.size(); ++i) {
      const float* const v = low_.data() + kOctantSize * i;
      const float* const w = high_.data() + kOctantSize * i;
      const float least = v[0] < v[1] ? v[0] : v[1];
      const float most = w[0] > w[1] ? w[0] : w[1];
      octants_.lowest[i] = least < v[2] ? least : v[2];
      octants_.highest[i] = most > w[2] ? most : w[2];
    }
    return octants_;
  }

 private:
  std::size_t begin_, count_;
  std::vector<float> low_, high_;  ///< the row's voxels; infinite where there is none
  OctantRow octants_;
};

}  // namespace

Macrocells::Macrocells(const IndexBox& storedVoxels, bool isWhole) {
  for (int axis = 0; axis < 3; ++axis) {
    firstCell_[axis] = floorDivide(storedVoxels.lo[axis], kMacrocellSize);
    // The last voxel alone opens no macrocell unless it is the only one.
    const int lastCell = std::max(storedVoxels.hi[axis] - 2, storedVoxels.lo[axis]);
    size_[axis] = floorDivide(lastCell, kMacrocellSize) - firstCell_[axis] + 1;
  }
  ranges_ = MacrocellRanges{IndexBox{glm::ivec3{0}, size_}.count(), isWhole};
}

void Macrocells::add(const IndexBox& box, std::span<const float> stored) {
  BURIN_CHECK_EQ(stored.size(), box.count());
  const IndexBox local{box.lo - origin(), box.hi - origin()};
  const auto width = static_cast<std::size_t>(box.size().x);
  RowExtremes extremes{size_.x, local.lo.x, local.hi.x};
  const float* row = stored.data();
  for (int z = local.lo.z; z < local.hi.z; ++z) {
    keepBefore(z);
    const Span planes = octantsOfVoxel(z, size_.z);
    for (int y = local.lo.y; y < local.hi.y; ++y, row += width) {
      const OctantRow& octants = extremes.of(row);
      const Span rows = octantsOfVoxel(y, size_.y);
      for (int k = planes.first; k <= planes.last; ++k)
        for (int j = rows.first; j <= rows.last; ++j) plane(k).add(j, octants);
    }
  }
}

OctantPlane& Macrocells::plane(int number) {
  while (firstPlane_ + static_cast<int>(planes_.size()) <= number)
    planes_.emplace_back(kSides * glm::ivec2{size_});
  return planes_[static_cast<std::size_t>(number - firstPlane_)];
}

/// The layers of which all voxels, and those of the next plane of octants, lie before that one.
void Macrocells::keepBefore(int voxelFromFirst) {
  while (kept_ < size_.z && kMacrocellSize * (kept_ + 1) + kOctantSize < voxelFromFirst) keepNext();
}

void Macrocells::finish() {
  while (kept_ < size_.z) keepNext();
  planes_.clear();
}

/// The ranges of the octants (·, y, z).
void Macrocells::widenedRow(int y, int z, OctantRow& row) {
  plane(z).widenedRow(y, z > 0 ? &plane(z - 1) : nullptr,
                      z + 1 < kSides * size_.z ? &plane(z + 1) : nullptr, row);
}

void Macrocells::keepNext() {
  std::array<OctantRow, kSides * kSides> rows;
  std::size_t cell = static_cast<std::size_t>(kept_) * static_cast<std::size_t>(size_.x) *
                     static_cast<std::size_t>(size_.y);
  for (int y = 0; y < size_.y; ++y) {
    for (int k = 0; k < static_cast<int>(rows.size()); ++k)
      widenedRow(kSides * y + k % kSides, kSides * kept_ + k / kSides,
                 rows[static_cast<std::size_t>(k)]);
    for (std::size_t x = 0; x < static_cast<std::size_t>(size_.x); ++x, ++cell) {
      std::array<ValueRange, kOctants> octants;
      for (std::size_t i = 0; i < kOctants; ++i)
        octants[i] = rows[i / kSides].at(kSides * x + i % kSides);
      ranges_.set(cell, octants);
    }
  }
  ++kept_;
  for (; firstPlane_ < kSides * kept_ - 1; ++firstPlane_) planes_.pop_front();
}

IndexBox Macrocells::boxOf(std::span<const OctantMask> marks) const {
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
