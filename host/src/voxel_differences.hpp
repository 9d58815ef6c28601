#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/host/histogram.hpp"
#include "burin/node/brick_source.hpp"
#include "burin/node/survey.hpp"

namespace burin::host {

/// Three z slices of a volume, so that all neighbours of the middle one's voxels are there.
class SliceWindow {
 public:
  explicit SliceWindow(const node::VolumeInfo& info);

  /// Slice z, of the source's type; slices come in ascending order.
  void load(int z, std::span<const std::byte> voxels);

  /// visit(value, difference) for each voxel of each `stride`-th row of slice z, whose neighbours
  /// have been loaded: what the value rises by along each index axis from the voxel before to the
  /// one behind, which are clamped at the volume.
  template <typename Visit>
  void visitSlice(int z, int stride, Visit& visit) const {
    const std::vector<float>& here = slice(z);
    const std::vector<float>& below = slice(std::max(z - 1, 0));
    const std::vector<float>& above = slice(std::min(z + 1, dims_.z - 1));
    for (int y = 0; y < dims_.y; y += stride) {
      for (int x = 0; x < dims_.x; ++x) {
        const std::size_t at = offset(x, y);
        const glm::dvec3 difference{double{here[offset(std::min(x + 1, dims_.x - 1), y)]} -
                                        double{here[offset(std::max(x - 1, 0), y)]},
                                    double{here[offset(x, std::min(y + 1, dims_.y - 1))]} -
                                        double{here[offset(x, std::max(y - 1, 0))]},
                                    double{above[at]} - double{below[at]}};
        visit(double{here[at]}, difference);
      }
    }
  }

 private:
  const std::vector<float>& slice(int z) const { return slices_[static_cast<std::size_t>(z % 3)]; }
  std::size_t offset(int x, int y) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(y) * static_cast<std::size_t>(dims_.x);
  }

  node::VoxelType type_;
  glm::ivec3 dims_;
  std::array<std::vector<float>, 3> slices_;
};

/// Collective. SliceWindow's visit(value, difference) for each voxel of ownSlices(), or of each
/// `stride`-th row of each `stride`-th slice of the volume among them. Throws CollectiveError if
/// reading fails.
template <typename Visit>
void forVoxelDifferences(const Communicator& comm, node::BrickSource& source, int stride,
                         Visit visit) {
  const glm::ivec3 dims = source.info().grid.dims;
  const IndexBox mine = ownSlices(comm, dims);
  IndexBox withNeighbours = mine;
  if (!mine.empty()) {
    withNeighbours.lo.z = std::max(mine.lo.z - 1, 0);
    withNeighbours.hi.z = std::min(mine.hi.z + 1, dims.z);
  }
  SliceWindow window{source.info()};
  const auto visitOwn = [&](int z) {
    if (z >= mine.lo.z && z < mine.hi.z && z % stride == 0) window.visitSlice(z, stride, visit);
  };
  node::readSlabs(comm, source, std::span{&withNeighbours, 1}, [&](const node::Slab& slab) {
    const std::size_t bytes = slab.voxels.size() / static_cast<std::size_t>(slab.box.size().z);
    for (int z = slab.box.lo.z; z < slab.box.hi.z; ++z) {
      window.load(z, slab.voxels.subspan(bytes * static_cast<std::size_t>(z - slab.box.lo.z)));
      visitOwn(z - 1);
      if (z == dims.z - 1) visitOwn(z);
    }
  });
}

}  // namespace burin::host
