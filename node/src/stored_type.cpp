#include "stored_type.hpp"

#include <array>

namespace burin::node {
namespace {

struct StoredTypeEntry {
  StoredType type;
  const char* name;
  VoxelType delivered;
};

constexpr std::array<StoredTypeEntry, 10> kStoredTypes{
    {{StoredType::kU8, "u8", VoxelType::kU8},
     {StoredType::kI8, "i8", VoxelType::kI16},
     {StoredType::kU16, "u16", VoxelType::kU16},
     {StoredType::kI16, "i16", VoxelType::kI16},
     {StoredType::kU32, "u32", VoxelType::kF32},
     {StoredType::kI32, "i32", VoxelType::kF32},
     {StoredType::kU64, "u64", VoxelType::kF32},
     {StoredType::kI64, "i64", VoxelType::kF32},
     {StoredType::kF32, "f32", VoxelType::kF32},
     {StoredType::kF64, "f64", VoxelType::kF32}}};

const StoredTypeEntry& entryOf(StoredType type) {
  for (const StoredTypeEntry& entry : kStoredTypes) {
    if (entry.type == type) return entry;
  }
  throw std::logic_error{"stored type out of range"};
}

}  // namespace

std::size_t bytesPerNumber(StoredType type) {
  return withStoredType(type, [](auto tag) { return sizeof(typename decltype(tag)::Type); });
}

const char* storedTypeName(StoredType type) {
  return entryOf(type).name;
}

std::optional<StoredType> storedTypeFromName(std::string_view name) {
  for (const StoredTypeEntry& entry : kStoredTypes) {
    if (name == entry.name) return entry.type;
  }
  return std::nullopt;
}

std::string_view supportedTypeNames() {
  return "u8, i8, u16, i16, u32, i32, u64, i64, f32, f64";
}

VoxelType deliveredType(StoredType type) {
  return entryOf(type).delivered;
}

}  // namespace burin::node
