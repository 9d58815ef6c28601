#include "burin/compositor/sparse_tile.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "burin/compositor/combine_tiles.hpp"
#include "test_images.hpp"

namespace burin::compositor {
namespace {

using test::Affine;

struct Memory {
  FrameMemory pixels;
  FrameMemory runs;
  TileMemory tiles() { return {pixels, runs}; }
};

TEST(FrameMemory, PiecesAreApartAndComeFromTheGivenSpanFirst) {
  alignas(64) std::byte first[256];
  FrameMemory memory{first};
  const auto a = memory.allocate<std::uint32_t>(16);
  const auto b = memory.keepFirst(memory.allocate<std::uint32_t>(32), 1);
  const auto c = memory.allocate<std::uint32_t>(16);  // where the end of b was
  const auto large = memory.allocate<std::byte>(10'000'000);
  EXPECT_EQ(static_cast<void*>(a.data()), first);
  EXPECT_EQ(b.data(), a.data() + 16);
  EXPECT_EQ(c.data(), b.data() + 16);
  std::ranges::fill(large, std::byte{1});
  const auto again = [&] {
    memory.reset();
    return memory.allocate<std::uint32_t>(16).data();
  };
  EXPECT_EQ(again(), a.data());
  EXPECT_EQ(memory.allocate<std::byte>(10'000'000).data(), large.data());  // kept
}

// Frames that each need a little more than the one before: memory follows the need, not its sum.
TEST(FrameMemory, GrowingFramesDoNotPileUpBlocks) {
  FrameMemory memory;
  constexpr std::size_t kMegabyte = std::size_t{1} << 20;
  for (std::size_t frame = 1; frame <= 40; ++frame) {
    memory.reset();
    memory.allocate<std::byte>(frame * kMegabyte);
    EXPECT_LE(memory.heapBytes(), 2 * frame * kMegabyte + 2 * kMegabyte);
  }
}

TEST(SparseTile, PasteOfCompressedIsTheImage) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    test::Random random{seed};
    const ImageSize size{1 + test::below(random, 150), 1 + test::below(random, 90)};
    auto image = test::randomSubimage<Affine>(size, test::randomRect(size, random), random);
    test::punchHoles<Affine>(image, test::unit(random), random);
    const TileGrid grid{size};
    Memory memory;
    const Keep keep = seed % 2 == 0 ? Keep::kCopy : Keep::kInPlace;
    const auto tiles = compress<Affine>(image, grid, keep, memory.tiles());
    Image<Affine::Pixel> out{size};  // of pixels that are no identity: all must be written
    std::ranges::fill(out.pixels(), Affine::Pixel{7, 7});
    for (std::size_t tile = 0; tile < grid.count(); ++tile) {
      pasteTile<Affine>(tiles[tile], grid.rect(tile), ImageView<Affine::Pixel>{out});
    }
    EXPECT_TRUE(test::areEqual(out, test::combineSerially<Affine>(size, {image})));
  }
}

TEST(SparseTile, HoldsActivePixelsOnlyInRunsThatDoNotTouch) {
  test::Random random{1};
  const ImageSize size{64, 32};
  auto image = test::randomSubimage<Over>(size, {5, 3, 60, 31}, random);
  test::punchHoles<Over>(image, 0.5f, random);
  const TileGrid grid{size};
  Memory memory;
  std::size_t active = 0;
  for (const auto& tile : compress<Over>(image, grid, Keep::kCopy, memory.tiles())) {
    std::uint32_t pixels = 0;
    for (std::size_t i = 0; i < tile.runs.size(); ++i) {
      pixels += tile.runs[i].pixels();
      if (i > 0) {
        EXPECT_GT(tile.runs[i].first, tile.runs[i - 1].end());
      }
    }
    EXPECT_EQ(pixels, tile.active);
    EXPECT_TRUE(std::ranges::none_of(test::pixelsOf(tile), Over::isIdentity));
    active += tile.active;
  }
  EXPECT_EQ(active, static_cast<std::size_t>(std::ranges::count_if(
                        image.pixels, [](const Rgba& p) { return !Over::isIdentity(p); })));
}

TEST(SparseTile, SubimageMustHaveItsPixelsInsideTheFrame) {
  EXPECT_THROW(checkSubimage<Rgba>(Subimage<Rgba>{{4, 4}, {0, 0, 2, 2}, std::vector<Rgba>(3)}),
               Error);
  EXPECT_THROW(checkSubimage<Rgba>(Subimage<Rgba>{{4, 4}, {0, 0, 5, 1}, std::vector<Rgba>(5)}),
               Error);
  EXPECT_THROW(checkSubimage<Rgba>(Subimage<Rgba>{{4, 4}, {-1, 0, 1, 1}, std::vector<Rgba>(2)}),
               Error);
  EXPECT_NO_THROW(checkSubimage<Rgba>(Subimage<Rgba>{{4, 4}, {3, 3, 4, 4}, std::vector<Rgba>(1)}));
}

TEST(TileCombiner, FoldEqualsTheSerialCombination) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    test::Random random{seed};
    const ImageSize size{120, 1};
    const TileGrid grid{size};
    ASSERT_EQ(grid.count(), 1U);
    Memory memory;
    std::deque<Subimage<Affine::Pixel>> images;  // tiles refer to them
    std::vector<SparseTile<Affine::Pixel>> tiles;
    for (int i = 0; i < 1 + test::below(random, 6); ++i) {
      images.push_back(test::randomSubimage<Affine>(size, test::randomRect(size, random), random));
      test::punchHoles<Affine>(images.back(), test::unit(random), random);
      tiles.push_back(compress<Affine>(images.back(), grid,
                                       i % 2 == 0 ? Keep::kCopy : Keep::kInPlace, memory.tiles())
                          .front());
    }
    TileCombiner<Affine> combiner;
    const auto tile = combiner.fold(tiles, grid.pixels(0), memory.tiles());
    Image<Affine::Pixel> out{size};
    pasteTile<Affine>(tile, grid.rect(0), out);
    EXPECT_TRUE(
        test::areEqual(out, test::combineSerially<Affine>(size, {images.begin(), images.end()})))
        << seed;
    for (std::size_t i = 1; i < tile.runs.size(); ++i) {
      EXPECT_GT(tile.runs[i].first, tile.runs[i - 1].end());
    }
  }
}

TEST(TileCombiner, OneTileAloneIsNotCopied) {
  test::Random random{3};
  const ImageSize size{32, 4};
  const TileGrid grid{size};
  Memory memory;
  const auto image = test::randomSubimage<Over>(size, {0, 0, 20, 4}, random);
  const auto tiles = compress<Over>(image, grid, Keep::kCopy, memory.tiles());
  TileCombiner<Over> combiner;
  const SparseTile<Rgba> stack[] = {{}, tiles.front(), {}};
  EXPECT_EQ(combiner.fold(stack, grid.pixels(0), memory.tiles()).pixels, tiles.front().pixels);
  EXPECT_TRUE(combiner.fold({}, grid.pixels(0), memory.tiles()).empty());
}

}  // namespace
}  // namespace burin::compositor
