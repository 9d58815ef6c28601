#include "burin/node/brick_source.hpp"

#include <array>
#include <cstring>
#include <utility>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

struct TypeEntry {
  VoxelType type;
  const char* name;
  std::size_t bytes;
};

constexpr std::array<TypeEntry, 4> kTypes{{{VoxelType::kU8, "u8", 1},
                                           {VoxelType::kI16, "i16", 2},
                                           {VoxelType::kU16, "u16", 2},
                                           {VoxelType::kF32, "f32", 4}}};

const TypeEntry& entryOf(VoxelType type) {
  for (const TypeEntry& entry : kTypes) {
    if (entry.type == type) return entry;
  }
  throw std::logic_error{"voxel type out of range"};
}

std::size_t offsetInBox(const IndexBox& box, int x, int y, int z) {
  const glm::ivec3 size = box.size();
  const auto row = static_cast<std::size_t>(z - box.lo.z) * static_cast<std::size_t>(size.y) +
                   static_cast<std::size_t>(y - box.lo.y);
  return row * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x - box.lo.x);
}

}  // namespace

std::size_t bytesPerVoxel(VoxelType type) {
  return entryOf(type).bytes;
}

const char* voxelTypeName(VoxelType type) {
  return entryOf(type).name;
}

std::optional<VoxelType> voxelTypeFromName(std::string_view name) {
  for (const TypeEntry& entry : kTypes) {
    if (name == entry.name) return entry.type;
  }
  return std::nullopt;
}

void checkLoad(const VolumeInfo& info, const IndexBox& region, std::span<const std::byte> out) {
  BURIN_CHECK((IndexBox{glm::ivec3{0}, info.grid.dims}.contains(region)));
  BURIN_CHECK_EQ(out.size(), region.count() * bytesPerVoxel(info.type));
}

void copyVoxels(std::span<const std::byte> from, const IndexBox& fromBox, std::span<std::byte> to,
                const IndexBox& toBox, const IndexBox& part, std::size_t bytesPerVoxel) {
  BURIN_CHECK(part.empty() || (fromBox.contains(part) && toBox.contains(part)));
  BURIN_CHECK_EQ(from.size(), fromBox.count() * bytesPerVoxel);
  BURIN_CHECK_EQ(to.size(), toBox.count() * bytesPerVoxel);
  if (part.empty()) return;
  const std::size_t rowBytes = static_cast<std::size_t>(part.size().x) * bytesPerVoxel;
  for (int z = part.lo.z; z < part.hi.z; ++z) {
    for (int y = part.lo.y; y < part.hi.y; ++y) {
      std::memcpy(to.data() + offsetInBox(toBox, part.lo.x, y, z) * bytesPerVoxel,
                  from.data() + offsetInBox(fromBox, part.lo.x, y, z) * bytesPerVoxel, rowBytes);
    }
  }
}

}  // namespace burin::node
