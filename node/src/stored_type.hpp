#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string_view>

#include "voxel_access.hpp"

namespace burin::node {

/// Number types that files hold. A source delivers the four of VoxelType.
enum class StoredType : std::uint8_t { kU8, kI8, kU16, kI16, kU32, kI32, kU64, kI64, kF32, kF64 };

std::size_t bytesPerNumber(StoredType type);
const char* storedTypeName(StoredType type);  ///< "u8", "i8", ... "f64"
std::optional<StoredType> storedTypeFromName(std::string_view name);

/// "u8, i8, u16, i16, ...": what messages list as supported.
std::string_view supportedTypeNames();

/// The type in which such numbers are delivered: themselves if they can be; i8 as i16, which is
/// exact; the wider ones as f32, each the nearest one.
VoxelType deliveredType(StoredType type);

/// Calls `work` with the TypeTag of the C++ type that holds such numbers.
template <typename Work>
auto withStoredType(StoredType type, Work&& work) {
  switch (type) {
    case StoredType::kU8:
      return work(TypeTag<std::uint8_t>{});
    case StoredType::kI8:
      return work(TypeTag<std::int8_t>{});
    case StoredType::kU16:
      return work(TypeTag<std::uint16_t>{});
    case StoredType::kI16:
      return work(TypeTag<std::int16_t>{});
    case StoredType::kU32:
      return work(TypeTag<std::uint32_t>{});
    case StoredType::kI32:
      return work(TypeTag<std::int32_t>{});
    case StoredType::kU64:
      return work(TypeTag<std::uint64_t>{});
    case StoredType::kI64:
      return work(TypeTag<std::int64_t>{});
    case StoredType::kF32:
      return work(TypeTag<float>{});
    case StoredType::kF64:
      return work(TypeTag<double>{});
  }
  throw std::logic_error{"stored type out of range"};
}

}  // namespace burin::node
