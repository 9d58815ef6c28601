#include "burin/compositor/tile_message.hpp"

#include <gtest/gtest.h>

#include "test_images.hpp"

namespace burin::compositor {
namespace {

using test::Affine;

/// Tiles of a random image, all of them the region [10, 10 + count).
template <PixelAlgebra A>
class Sample {
 public:
  explicit Sample(unsigned seed, std::span<std::byte> shared = {}) : pixels{shared} {
    test::Random random{seed};
    auto image = test::randomSubimage<A>(size, {3, 1, 90, 55}, random);
    test::punchHoles<A>(image, 0.6f, random);
    tiles = compress<A>(image, grid, Keep::kCopy, {pixels, runs});
    region = {10, 10 + tiles.size()};
  }

  EncodedMessage encode(const Transfer& transfer) {
    return encodeTiles<A>(std::span<const SparseTile<typename A::Pixel>>{tiles}, region, transfer,
                          messages);
  }
  DecodedMessage<typename A::Pixel> decode(std::span<const std::byte> message,
                                           const SharedSpaces& spaces = {}) {
    return decodeTiles<A>(
        message, region, [&](std::size_t position) { return grid.rect(position - 10); }, spaces,
        messages);
  }
  bool equals(const DecodedMessage<typename A::Pixel>& decoded) const {
    std::size_t next = 0;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      if (tiles[i].empty()) continue;
      if (next == decoded.tiles.size()) return false;
      const auto& [position, tile] = decoded.tiles[next++];
      if (position != 10 + i || !std::ranges::equal(tile.runs, tiles[i].runs) ||
          test::pixelsOf(tile) != test::pixelsOf(tiles[i])) {
        return false;
      }
    }
    return next == decoded.tiles.size();
  }

  ImageSize size{100, 60};
  TileGrid grid{size};
  FrameMemory pixels, runs, messages;
  SparseImage<typename A::Pixel> tiles;
  Region region;
};

TEST(TileMessage, ArrivesByValue) {
  Sample<Affine> sample{1};
  const EncodedMessage message = sample.encode({});
  EXPECT_TRUE(sample.equals(sample.decode(message.bytes)));
  EXPECT_EQ(message.referred, 0U);
}

TEST(TileMessage, ArrivesPacked) {
  Sample<Over> sample{2};
  for (auto& tile : sample.tiles) {  // something that can be packed
    for (Rgba& pixel : std::span{const_cast<Rgba*>(tile.pixels), tile.active}) {
      pixel = {0.25f, 0.125f, 0, 0.5f};
    }
  }
  const EncodedMessage plain = sample.encode({});
  const EncodedMessage packed = sample.encode({nullptr, true});
  EXPECT_LT(packed.bytes.size(), plain.bytes.size() / 2);
  EXPECT_EQ(packed.bytes.size() + packed.packedAway, plain.bytes.size());
  EXPECT_TRUE(sample.equals(sample.decode(packed.bytes)));
}

TEST(TileMessage, IsSentPlainWhenPackingDoesNotPay) {
  Sample<Affine> sample{3};  // random bits
  const EncodedMessage plain = sample.encode({});
  const EncodedMessage packed = sample.encode({nullptr, true});
  EXPECT_LE(packed.bytes.size(), plain.bytes.size());
  EXPECT_TRUE(sample.equals(sample.decode(packed.bytes)));
}

TEST(TileMessage, ArrivesByReference) {
  std::vector<std::byte> memory(1 << 20);
  Sample<Affine> sample{4, memory};
  const SharedSpaces spaces{{{}, {}, std::span<const std::byte>{memory}}};
  const EncodedMessage message = sample.encode({&spaces, false});
  const auto decoded = sample.decode(message.bytes, spaces);
  EXPECT_TRUE(sample.equals(decoded));
  EXPECT_GT(message.referred, 0U);
  EXPECT_EQ(message.referred, decoded.referred);
  // Nobody may read memory that he does not share.
  EXPECT_THROW(sample.decode(message.bytes, SharedSpaces{}), Error);
  const SharedSpaces shorter{{{}, {}, std::span<const std::byte>{memory}.first(64)}};
  EXPECT_THROW(sample.decode(message.bytes, shorter), Error);
}

TEST(TileMessage, TilesOutsideTheSharedMemoryAreSentByValue) {
  std::vector<std::byte> memory(1 << 20);
  Sample<Affine> sample{5, std::span{memory}.first(4000)};  // the rest is on the heap
  const SharedSpaces spaces{{std::span<const std::byte>{memory}}};
  const EncodedMessage message = sample.encode({&spaces, false});
  EXPECT_TRUE(sample.equals(sample.decode(message.bytes, spaces)));
  EXPECT_GT(message.referred, 0U);
  EXPECT_GT(message.bytes.size(), 4000U);
}

// Whatever bytes come: an error or tiles of this region; with address sanitizer, nothing outside
// the message is read.
TEST(TileMessage, DamageIsAnErrorOrAnotherPicture) {
  std::vector<std::byte> memory(1 << 20);
  Sample<Affine> sample{6, std::span{memory}.first(4000)};
  const SharedSpaces spaces{{std::span<const std::byte>{memory}}};
  int errors = 0;
  for (const bool isPacked : {false, true}) {
    const auto message = sample.encode({isPacked ? nullptr : &spaces, isPacked}).bytes;
    const auto tryIt = [&](std::span<const std::byte> bytes) {
      const std::vector<std::byte> exact(bytes.begin(), bytes.end());  // no room behind its end
      sample.messages.reset();
      try {
        for (const auto& placed : sample.decode(exact, spaces).tiles) {
          EXPECT_TRUE(placed.position >= sample.region.begin &&
                      placed.position < sample.region.end);
          EXPECT_LE(placed.tile.runs.back().end(), sample.grid.pixels(placed.position - 10));
        }
      } catch (const Error& e) {
        EXPECT_EQ(e.code(), ExitCode::kRank);
        ++errors;
      }
    };
    const std::vector<std::byte> kept(message.begin(), message.end());
    for (std::size_t length = 0; length < kept.size(); length += 1 + length / 50) {
      const int before = errors;
      tryIt(std::span{kept}.first(length));
      EXPECT_EQ(errors, before + 1) << "cut to " << length;
    }
    test::Random random{7};
    for (int trial = 0; trial < 3000; ++trial) {
      auto damaged = kept;
      const int last = trial % 2 == 0 ? 400 : static_cast<int>(kept.size());
      for (int i = 0; i <= trial % 3; ++i) {
        damaged[static_cast<std::size_t>(test::below(random, last))] =
            static_cast<std::byte>(random());
      }
      tryIt(damaged);
    }
  }
  EXPECT_GT(errors, 1000);
}

TEST(TileMessage, IsForOneRegionAndOnePixelType) {
  Sample<Affine> sample{8};
  const auto message = sample.encode({}).bytes;
  Sample<Over> other{8};
  EXPECT_THROW(other.decode(message), Error);
  sample.region = {11, 11 + sample.tiles.size()};
  EXPECT_THROW(sample.decode(message), Error);
}

TEST(TileMessage, EmptyOneCarriesNothing) {
  Sample<Affine> sample{9};
  const auto message = emptyTileMessage(sample.region, Affine::kMaxWireBytes);
  EXPECT_TRUE(sample.decode(message).tiles.empty());
}

}  // namespace
}  // namespace burin::compositor
