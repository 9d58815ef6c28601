#include "voxel_access.hpp"

#include "burin/common/error.hpp"

namespace burin::node {

void widenToFloat(VoxelType type, std::span<const std::byte> voxels, std::span<float> out) {
  BURIN_CHECK_EQ(voxels.size(), out.size() * bytesPerVoxel(type));
  withVoxelType(type, [&](auto tag) {
    using Voxel = typename decltype(tag)::Type;
    const std::byte* from = voxels.data();
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = static_cast<float>(voxelAt<Voxel>(from, i));
    }
  });
}

void widenToFloat(VoxelType type, std::span<const std::byte> voxels, float lowest, float highest,
                  std::span<float> out) {
  widenToFloat(type, voxels, out);
  if (type != VoxelType::kF32) return;
  for (float& value : out) {
    value = value < lowest ? lowest : value;  // comparisons with NaN are false
    value = value > highest ? highest : value;
  }
}

}  // namespace burin::node
