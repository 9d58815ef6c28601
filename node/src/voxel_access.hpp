#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>

#include "burin/node/brick_source.hpp"

namespace burin::node {

template <typename T>
struct TypeTag {
  using Type = T;
};

/// Calls `work` with the TypeTag of the C++ type that holds such voxels.
template <typename Work>
auto withVoxelType(VoxelType type, Work&& work) {
  switch (type) {
    case VoxelType::kU8:
      return work(TypeTag<std::uint8_t>{});
    case VoxelType::kI16:
      return work(TypeTag<std::int16_t>{});
    case VoxelType::kU16:
      return work(TypeTag<std::uint16_t>{});
    case VoxelType::kF32:
      return work(TypeTag<float>{});
  }
  throw std::logic_error{"voxel type out of range"};
}

/// Element `index` of voxel bytes that need not be aligned.
template <typename T>
T voxelAt(const std::byte* voxels, std::size_t index) {
  T value;
  std::memcpy(&value, voxels + index * sizeof(T), sizeof value);
  return value;
}

/// Voxel bytes as floats, exact for all four types. `voxels` holds out.size() of them.
void widenToFloat(VoxelType type, std::span<const std::byte> voxels, std::span<float> out);
/// The same clamped to [lowest, highest], which takes infinities to the finite ends; NaN stays NaN.
void widenToFloat(VoxelType type, std::span<const std::byte> voxels, float lowest, float highest,
                  std::span<float> out);

}  // namespace burin::node
