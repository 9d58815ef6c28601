#pragma once

#include <bit>
#include <cstddef>
#include <span>

namespace burin::node {

/// Whether voxels stored in that order must be swapped on this machine.
constexpr bool swapNeeded(bool storedBigEndian) {
  return storedBigEndian != (std::endian::native == std::endian::big);
}

/// Reverses the bytes of each element in place; elements of 1, 2, 4 or 8 bytes.
void swapBytes(std::span<std::byte> elements, std::size_t bytesPerElement);

}  // namespace burin::node
