#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "burin/compositor/message_layout.hpp"
#include "burin/compositor/shared_spaces.hpp"
#include "burin/compositor/sparse_tile.hpp"

namespace burin::compositor {

/// A tile and its position in the frame's sequence of tiles.
template <typename Pixel>
struct PlacedTile {
  std::size_t position = 0;
  SparseTile<Pixel> tile;
};

/// How pixels get into a message.
struct Transfer {
  const SharedSpaces* spaces = nullptr;  ///< by reference where pixels lie in one of these
  bool isPacked = false;                 ///< with zstd, what is sent by value
};

/// Whether pixels travel as float RGBA.
template <PixelAlgebra A>
inline constexpr bool kIsColour = A::kWireIsMemory&& std::is_same_v<typename A::Pixel, Rgba>;

struct EncodedMessage {
  std::span<const std::byte> bytes;
  std::size_t referred = 0;    ///< bytes of pixels that it refers to
  std::size_t packedAway = 0;  ///< bytes that zstd saved
};

template <typename Pixel>
struct DecodedMessage {
  std::vector<PlacedTile<Pixel>> tiles;
  std::size_t referred = 0;
};

/// The message that carries the tiles of `region` (tiles[0] is the region's first; empty ones cost
/// nothing), made in `memory`.
template <PixelAlgebra A>
EncodedMessage encodeTiles(std::span<const SparseTile<typename A::Pixel>> tiles,
                           const Region& region, const Transfer& transfer, FrameMemory& memory) {
  EncodedMessage message;
  std::vector<TileEntry> entries;
  std::size_t runs = 0;
  std::size_t active = 0;  // of tiles sent by value
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const auto& tile = tiles[i];
    if (tile.empty()) continue;
    TileEntry entry{static_cast<std::uint32_t>(region.begin + i),
                    static_cast<std::uint32_t>(tile.runs.size()),
                    tile.stride,
                    {}};
    if (transfer.spaces != nullptr && A::kWireIsMemory) {
      const auto bytes = std::as_bytes(std::span{tile.pixels, tile.extent()});
      entry.place = transfer.spaces->find(bytes).value_or(entry.place);
    }
    (entry.place.rank < 0 ? active : message.referred) += tile.active;
    runs += tile.runs.size();
    entries.push_back(entry);
  }
  const MessageLayout layout{entries.size(), runs, transfer.spaces != nullptr};
  const auto room = memory.allocate<std::byte>(layout.payloadBegin() + active * A::kMaxWireBytes);
  auto payload = room.subspan(layout.payloadBegin());
  std::size_t used = 0;
  std::byte* runBytes = room.data() + layout.runsBegin();
  for (const TileEntry& entry : entries) {
    const auto& tile = tiles[entry.position - region.begin];
    std::memcpy(runBytes, tile.runs.data(), tile.runs.size_bytes());
    runBytes += tile.runs.size_bytes();
    if (entry.place.rank >= 0) continue;
    tile.forEachRun([&](const Run& run, const auto* pixels) {
      if constexpr (A::kWireIsMemory) {
        const std::size_t bytes = run.pixels() * sizeof(*pixels);
        std::memcpy(payload.data() + used, pixels, bytes);
        used += bytes;
      } else {
        for (std::uint32_t k = 0; k < run.pixels(); ++k) {
          used += A::store(pixels[k], payload.subspan(used));
        }
      }
    });
  }
  message.bytes =
      finishMessage(room, layout, entries, {region, A::kMaxWireBytes, used, kIsColour<A>},
                    transfer.isPacked && used > 0, memory);
  message.referred *= sizeof(typename A::Pixel);
  message.packedAway = layout.payloadBegin() + used - message.bytes.size();
  return message;
}

/// The tiles that `message` carries for `region`. `rectOf(position)`: a tile's rectangle.
/// What travelled by value is referred to in the message where its form allows it, else put into
/// `memory`; the message must stay as long as the tiles. Throws Error{kRank} if the message is
/// damaged or not for this region; reads nothing outside it and the shared memories, and allocates
/// no more than the message's pixels can need.
template <PixelAlgebra A, typename RectOf>
DecodedMessage<typename A::Pixel> decodeTiles(std::span<const std::byte> message,
                                              const Region& region, RectOf&& rectOf,
                                              const SharedSpaces& spaces, FrameMemory& memory) {
  using Pixel = typename A::Pixel;
  const MessageParts parts = readMessage(message, region, A::kMinWireBytes, A::kMaxWireBytes,
                                         kIsColour<A>, rectOf, memory);
  DecodedMessage<Pixel> decoded;
  decoded.tiles.reserve(parts.entries.size());
  std::span<const Run> runs = parts.runs;
  std::span<const std::byte> payload = parts.payload;
  for (const TileEntry& entry : parts.entries) {
    PlacedTile<Pixel> placed{entry.position, {runs.first(entry.runs), nullptr, 0, 0, 0}};
    runs = runs.subspan(entry.runs);
    SparseTile<Pixel>& tile = placed.tile;
    for (const Run& run : tile.runs) tile.active += run.pixels();
    if (entry.place.rank >= 0) {
      tile.stride = entry.stride;
      tile.width = static_cast<std::uint32_t>(rectOf(entry.position).width());
      const auto bytes =
          A::kWireIsMemory ? spaces.at(entry.place, tile.extent() * sizeof(Pixel)) : std::nullopt;
      if (!bytes || !isAligned(bytes->data(), alignof(Pixel))) failShared(entry);
      tile.pixels = reinterpret_cast<const Pixel*>(bytes->data());
      decoded.referred += tile.active * sizeof(Pixel);
    } else if constexpr (A::kWireIsMemory) {
      const auto bytes = takeBytes(payload, tile.active * sizeof(Pixel));
      if (isAligned(bytes.data(), alignof(Pixel))) {
        tile.pixels = reinterpret_cast<const Pixel*>(bytes.data());
      } else {
        const auto copy = memory.allocate<Pixel>(tile.active);
        std::memcpy(copy.data(), bytes.data(), bytes.size());
        tile.pixels = copy.data();
      }
    } else {
      const auto copy = memory.allocate<Pixel>(tile.active);
      for (Pixel& pixel : copy) takeBytes(payload, checkedLength(A::load(payload, pixel)));
      tile.pixels = copy.data();
    }
    decoded.tiles.push_back(placed);
  }
  if (!payload.empty()) failLength(payload.size());
  return decoded;
}

}  // namespace burin::compositor
