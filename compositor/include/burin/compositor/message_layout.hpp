#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "burin/compositor/frame_memory.hpp"
#include "burin/compositor/region.hpp"
#include "burin/compositor/shared_spaces.hpp"
#include "burin/compositor/sparse_tile.hpp"

namespace burin::compositor {

/// The part of a message that does not depend on the pixel type. In the machine's byte order:
///
///     header   48 bytes: mark, flags, bytes per pixel, region, numbers of tiles and runs, lengths
///     entries  per tile with anything in it u32 position, u32 runs; if the message has references,
///              also i32 rank (-1: pixels are in this message), u32 stride (see SparseTile), u64
///              offset of the first pixel in that rank's shared memory
///     runs     u16 first, u16 last, tile after tile
///     payload  at the next multiple of 16: the pixels sent by value, tile after tile; or one zstd
///              frame of them, colours as differences (colour_prediction.hpp), the bytes of each
///              4-byte word in planes

/// A tile with active pixels.
struct TileEntry {
  std::uint32_t position = 0;
  std::uint32_t runs = 0;
  std::uint32_t stride = 0;
  SharedPlace place;  ///< rank -1: by value
};

/// Where the parts of a message begin.
struct MessageLayout {
  static constexpr std::size_t kHeaderBytes = 48;
  static constexpr std::size_t kPayloadAlignment = 16;
  std::size_t entries = 0;
  std::size_t runs = 0;
  bool hasReferences = false;

  std::size_t entryBytes() const { return hasReferences ? 24 : 8; }
  std::size_t runsBegin() const { return kHeaderBytes + entries * entryBytes(); }
  std::size_t payloadBegin() const {
    const std::size_t end = runsBegin() + runs * sizeof(Run);
    return (end + kPayloadAlignment - 1) / kPayloadAlignment * kPayloadAlignment;
  }
};

/// What the header says beside the layout.
struct MessageContent {
  Region region;
  std::size_t pixelBytes = 0;    ///< of one pixel on the wire, at most
  std::size_t payloadBytes = 0;  ///< before zstd
  bool isColour = false;         ///< pixels are float RGBA: colours are predicted before zstd
};

/// Writes header and entries into `room`, whose runs and payload are in place, and packs the
/// payload if asked to (into `memory`, if that makes it smaller). @returns the message.
std::span<const std::byte> finishMessage(std::span<std::byte> room, const MessageLayout& layout,
                                         std::span<const TileEntry> entries,
                                         const MessageContent& content, bool isPacked,
                                         FrameMemory& memory);

/// The message that carries no tile of `region`.
std::array<std::byte, MessageLayout::kHeaderBytes> emptyTileMessage(const Region& region,
                                                                    std::size_t pixelBytes);

/// A message taken apart; entries, runs and the payload's length are checked against each other.
struct MessageParts {
  std::vector<TileEntry> entries;  ///< ascending positions in the region
  std::span<const Run> runs;       ///< ascending in each tile, not touching, inside it
  std::span<const std::byte> payload;
};

/// Throws Error{kRank} if the message is damaged or not for `region`; `rectOf(position)`: the
/// rectangle of the tile at that position.
MessageParts readMessage(std::span<const std::byte> message, const Region& region,
                         std::size_t minPixelBytes, std::size_t maxPixelBytes, bool isColour,
                         const std::function<PixelRect(std::size_t)>& rectOf, FrameMemory& memory);

bool isAligned(const std::byte* address, std::size_t alignment);
/// Takes `count` bytes from the front. Throws Error{kRank} if there are fewer.
std::span<const std::byte> takeBytes(std::span<const std::byte>& bytes, std::size_t count);
/// Throws Error{kRank} if `loaded`, what PixelAlgebra::load returned, is 0.
std::size_t checkedLength(std::size_t loaded);
[[noreturn]] void failShared(const TileEntry& entry);
[[noreturn]] void failLength(std::size_t surplus);

}  // namespace burin::compositor
