#include "burin/compositor/tile_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "burin/common/image.hpp"

namespace burin::compositor {
namespace {

const ImageSize kSizes[] = {{1, 1},       {509, 503},   {997, 1},       {1, 997},
                            {1024, 1024}, {2048, 2048}, {16384, 16384}, {16384, 1}};

TEST(TileGrid, EveryPixelIsInOneTile) {
  for (const ImageSize size : {ImageSize{1, 1}, ImageSize{509, 503}, ImageSize{997, 1}}) {
    const TileGrid grid{size};
    Image<int> hits{size};
    for (std::size_t tile = 0; tile < grid.count(); ++tile) {
      const PixelRect rect = grid.rect(tile);
      for (int y = rect.y0; y < rect.y1; ++y) {
        for (int x = rect.x0; x < rect.x1; ++x) ++hits.at(x, y);
      }
    }
    EXPECT_TRUE(std::ranges::all_of(hits.pixels(), [](int count) { return count == 1; }));
  }
}

TEST(TileGrid, PlacesFitIn16BitsAndTilesAreFew) {
  for (const ImageSize size : kSizes) {
    const TileGrid grid{size};
    std::size_t pixels = 0;
    for (std::size_t tile = 0; tile < grid.count(); ++tile) {
      EXPECT_LE(grid.pixels(tile), TileGrid::kMostTilePixels);
      EXPECT_GE(grid.pixels(tile), 1U);
      pixels += grid.pixels(tile);
    }
    EXPECT_EQ(pixels, size.pixels());
    const std::size_t needed = size.pixels() / TileGrid::kMostTilePixels;
    EXPECT_LE(grid.count(), std::max(TileGrid::kUsualTiles, 2 * needed)) << size.width;
  }
}

TEST(TileGrid, FrameWithoutPixelsHasNoTiles) {
  EXPECT_EQ(TileGrid{}.count(), 0U);
  EXPECT_EQ((TileGrid{ImageSize{0, 5}}.count()), 0U);
}

}  // namespace
}  // namespace burin::compositor
