#pragma once

#include <cstring>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "burin/common/error.hpp"
#include "burin/node/brick_source.hpp"

namespace burin::test {

/// A volume in memory, for tests: random access, nothing can fail.
class ArraySource : public node::BrickSource {
 public:
  /// `voxels`: info.bytes() of them, x fastest, native byte order.
  ArraySource(node::VolumeInfo info, std::vector<std::byte> voxels)
      : info_{std::move(info)}, voxels_{std::move(voxels)} {
    BURIN_CHECK_EQ(voxels_.size(), info_.bytes());
  }

  /// Float voxels `value(index)`.
  ArraySource(const VolumeGrid& grid, const std::function<float(glm::ivec3)>& value)
      : ArraySource{of<float>(grid, node::VoxelType::kF32, value)} {}

  /// Voxels of type T = the C++ type that `type` names, each `value(index)`.
  template <typename T>
  static ArraySource of(const VolumeGrid& grid, node::VoxelType type,
                        const std::function<T(glm::ivec3)>& value) {
    BURIN_CHECK_EQ(sizeof(T), node::bytesPerVoxel(type));
    std::vector<T> voxels;
    voxels.reserve(grid.voxelCount());
    for (int k = 0; k < grid.dims.z; ++k)
      for (int j = 0; j < grid.dims.y; ++j)
        for (int i = 0; i < grid.dims.x; ++i) voxels.push_back(value({i, j, k}));
    const auto bytes = std::as_bytes(std::span{voxels});
    return {{.name = "array", .format = "array", .grid = grid, .type = type},
            {bytes.begin(), bytes.end()}};
  }

  const node::VolumeInfo& info() const override { return info_; }
  bool randomAccess() const override { return true; }

  void load(const IndexBox& region, std::span<std::byte> out) override {
    node::checkLoad(info_, region, out);
    const std::size_t voxel = node::bytesPerVoxel(info_.type);
    const std::size_t row = static_cast<std::size_t>(region.size().x) * voxel;
    std::size_t written = 0;
    for (int k = region.lo.z; k < region.hi.z; ++k)
      for (int j = region.lo.y; j < region.hi.y; ++j, written += row)
        std::memcpy(out.data() + written, voxels_.data() + offset({region.lo.x, j, k}) * voxel,
                    row);
  }

 private:
  std::size_t offset(const glm::ivec3& at) const {
    const auto size = [](int n) { return static_cast<std::size_t>(n); };
    return size(at.x) +
           size(info_.grid.dims.x) * (size(at.y) + size(info_.grid.dims.y) * size(at.z));
  }

  node::VolumeInfo info_;
  std::vector<std::byte> voxels_;
};

}  // namespace burin::test
