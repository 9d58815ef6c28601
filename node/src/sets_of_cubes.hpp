#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "burin/common/error.hpp"
#include "clip_planes.hpp"

namespace burin::node {

/// What occurs in each cube of a grid, x fastest: the union of the sets (bits of a whole number) of
/// the voxels on its cells' corners and of those up to `reach` voxels further out.
template <typename Set>
class SetsOfCubes {
 public:
  SetsOfCubes() = default;
  SetsOfCubes(const CubeGrid& cubes, int reach)
      : cubes_{cubes}, reach_{reach}, sets_(IndexBox{glm::ivec3{0}, cubes.size}.count()) {}

  /// The sets of the voxels of a box, x fastest.
  void add(const IndexBox& box, std::span<const Set> ofVoxels) {
    BURIN_CHECK_EQ(ofVoxels.size(), box.count());
    const auto width = static_cast<std::size_t>(box.size().x);
    std::vector<Set> row(static_cast<std::size_t>(cubes_.size.x));
    for (int z = box.lo.z; z < box.hi.z; ++z)
      for (int y = box.lo.y; y < box.hi.y; ++y, ofVoxels = ofVoxels.subspan(width)) {
        gatherRow(box, ofVoxels.first(width), row);
        const Span slices = cubesOf(z, 2);
        const Span rows = cubesOf(y, 1);
        for (int k = slices.first; k <= slices.last; ++k)
          for (int j = rows.first; j <= rows.last; ++j) {
            Set* to = sets_.data() + static_cast<std::size_t>(k * cubes_.size.y + j) * row.size();
            for (std::size_t i = 0; i < row.size(); ++i) to[i] |= row[i];
          }
      }
  }

  const std::vector<Set>& sets() const { return sets_; }
  std::size_t bytes() const { return sets_.size() * sizeof(Set); }

 private:
  /// Cubes [first, last] along one axis.
  struct Span {
    int first, last;
  };
  Span cubesOf(int voxel, int axis) const {
    const int from = voxel - cubes_.origin[axis];
    const int cube = cubes_.cubeCells;
    // Cube c has the voxels [cube * c - reach, cube * (c + 1) + reach].
    const int first = from - reach_ <= 0 ? 0 : (from - reach_ - 1) / cube;
    return {first, std::min((from + reach_) / cube, cubes_.size[axis] - 1)};
  }

  void gatherRow(const IndexBox& box, std::span<const Set> ofVoxels, std::vector<Set>& row) const {
    for (int i = 0; i < cubes_.size.x; ++i) {
      const int begin = cubes_.origin.x + cubes_.cubeCells * i;
      const int from = std::max(begin - reach_, box.lo.x);
      const int to = std::min(begin + cubes_.cubeCells + reach_ + 1, box.hi.x);
      Set all = 0;
      for (int x = from; x < to; ++x) all |= ofVoxels[static_cast<std::size_t>(x - box.lo.x)];
      row[static_cast<std::size_t>(i)] = all;
    }
  }

  CubeGrid cubes_;
  int reach_ = 0;
  std::vector<Set> sets_;
};

}  // namespace burin::node
