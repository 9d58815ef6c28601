#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace burin {

/// One zstd frame that states its decompressed size. `level`: 1 (fast) … 19 (small).
/// Throws Error{kRank} if zstd fails (memory).
std::vector<std::byte> compressZstd(std::span<const std::byte> raw, int level = 1);

/// What compressZstd was given; nullopt if `packed` is anything but exactly one undamaged frame
/// that states a size of at most `largestSize` bytes, which is checked before that much is
/// allocated.
std::optional<std::vector<std::byte>> decompressZstd(std::span<const std::byte> packed,
                                                     std::size_t largestSize);

}  // namespace burin
