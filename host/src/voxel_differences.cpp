#include "voxel_differences.hpp"

#include <cstdint>
#include <cstring>

namespace burin::host {

namespace {

using node::VoxelType;

template <typename Voxel>
void widen(std::span<const std::byte> bytes, std::vector<float>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    Voxel voxel;
    std::memcpy(&voxel, bytes.data() + i * sizeof(Voxel), sizeof(Voxel));
    values[i] = static_cast<float>(voxel);
  }
}

void widen(VoxelType type, std::span<const std::byte> bytes, std::vector<float>& values) {
  switch (type) {
    case VoxelType::kU8:
      return widen<std::uint8_t>(bytes, values);
    case VoxelType::kI16:
      return widen<std::int16_t>(bytes, values);
    case VoxelType::kU16:
      return widen<std::uint16_t>(bytes, values);
    case VoxelType::kF32:
      return widen<float>(bytes, values);
  }
}

}  // namespace

SliceWindow::SliceWindow(const node::VolumeInfo& info) : type_{info.type}, dims_{info.grid.dims} {
  for (auto& slice : slices_)
    slice.resize(static_cast<std::size_t>(dims_.x) * static_cast<std::size_t>(dims_.y));
}

void SliceWindow::load(int z, std::span<const std::byte> voxels) {
  widen(type_, voxels, slices_[static_cast<std::size_t>(z % 3)]);
}

}  // namespace burin::host
