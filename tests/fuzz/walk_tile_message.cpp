#include <algorithm>

#include "burin/common/error.hpp"
#include "burin/compositor/combine_tiles.hpp"
#include "burin/compositor/tile_message.hpp"
#include "fuzzed_frame.hpp"
#include "tile_messages.hpp"

namespace burin::compositor::fuzz {

namespace {

template <typename Pixel>
void checkRuns(const SparseTile<Pixel>& tile, const PixelRect& rect) {
  std::size_t end = 0;
  std::size_t active = 0;
  for (const Run& run : tile.runs) {
    BURIN_CHECK(run.first >= end && run.last >= run.first && run.end() <= rect.pixels());
    end = run.end();
    active += run.pixels();
  }
  BURIN_CHECK(active > 0);
  BURIN_CHECK_EQ(active, tile.active);
}

/// Does with a decoded tile all that a rank does, and compares its pixels on every way.
template <PixelAlgebra A>
class TileWalk {
 public:
  using Pixel = typename A::Pixel;
  using Tile = SparseTile<Pixel>;

  void walk(const Tile& tile, const PixelRect& rect) {
    checkRuns(tile, rect);
    paste(tile, rect);
    expectPasted(tile, rect);
    const Run all{0, static_cast<std::uint16_t>(rect.pixels() - 1)};
    blank_.resize(rect.pixels(), A::identity());
    const Tile whole{{&all, 1}, blank_.data(), all.pixels(), 0, 0};
    // Behind it, in front of it and on both sides: the cursors meet each other in every way.
    BURIN_CHECK_EQ(fold({whole, tile}, rect).active, rect.pixels());
    BURIN_CHECK_EQ(fold({tile, whole, tile}, rect).active, rect.pixels());
    BURIN_CHECK_EQ(fold({tile, tile}, rect).active, tile.active);
  }

 private:
  Tile fold(std::initializer_list<Tile> tiles, const PixelRect& rect) {
    memory_.reset();
    const Tile folded = combiner_.fold(tiles, rect.pixels(), {memory_, memory_});
    checkRuns(folded, rect);
    return folded;
  }

  void paste(const Tile& tile, const PixelRect& rect) {
    pasteTile<A>(tile, rect, ImageView<Pixel>{kFrame, frame_.pixels()});
  }

  /// By bytes: a pixel that is NaN does not equal itself.
  void expectPasted(const Tile& tile, const PixelRect& rect) {
    const auto width = static_cast<std::size_t>(rect.width());
    tile.forEachRun([&](const Run& run, const Pixel* pixels) {
      for (std::size_t k = 0; k < run.pixels(); ++k) {
        const std::size_t place = run.first + k;
        const Pixel& pasted = frame_.at(rect.x0 + static_cast<int>(place % width),
                                        rect.y0 + static_cast<int>(place / width));
        BURIN_CHECK(std::memcmp(&pasted, pixels + k, sizeof(Pixel)) == 0);
      }
    });
  }

  Image<Pixel> frame_{kFrame};
  std::vector<Pixel> blank_;
  TileCombiner<A> combiner_;
  FrameMemory memory_;
};

template <PixelAlgebra A>
std::optional<Walked> walkMessage(std::span<const std::byte> message, const SharedSpaces& spaces) {
  static TileWalk<A> walk;
  FrameMemory memory;
  DecodedMessage<typename A::Pixel> decoded;
  try {
    decoded = decodeTiles<A>(message, kRegion, rectOf, spaces, memory);
  } catch (const Error& e) {
    BURIN_CHECK(e.code() == ExitCode::kRank);
    return std::nullopt;
  }
  Walked walked;
  std::size_t next = kRegion.begin;
  for (const auto& [position, tile] : decoded.tiles) {
    BURIN_CHECK(position >= next && position < kRegion.end);
    next = position + 1;
    walk.walk(tile, rectOf(position));
    ++walked.tiles;
    walked.active += tile.active;
  }
  return walked;
}

}  // namespace

std::optional<Walked> walkTileMessage(std::span<const std::byte> input) {
  if (input.empty()) return std::nullopt;
  static const FuzzedMemory memory;
  const Choice choice = Choice::of(input.front());
  // A copy that ends where the heap block does, at the address that was chosen.
  std::vector<std::byte> bytes;
  bytes.reserve(input.size());
  if (choice.isMisaligned) bytes.push_back({});
  bytes.insert(bytes.end(), input.begin() + 1, input.end());
  const auto message = std::span{std::as_const(bytes)}.subspan(choice.isMisaligned ? 1 : 0);
  return withAlgebra(choice.algebra, [&]<PixelAlgebra A>() {
    return walkMessage<A>(message, choice.hasSpaces ? memory.spaces() : SharedSpaces{});
  });
}

}  // namespace burin::compositor::fuzz
