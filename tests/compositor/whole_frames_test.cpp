// Pictures that are known beforehand, taken apart among ranks and composited again.
#include <gtest/gtest.h>

#include <optional>

#include "burin/compositor/in_process_executor.hpp"
#include "test_images.hpp"

namespace burin::compositor {
namespace {

using test::Affine;
using test::AffineMap;

std::vector<Rank> inOrder(int ranks) {
  std::vector<Rank> order;
  for (int i = 0; i < ranks; ++i) order.push_back(Rank{i});
  return order;
}

/// Every schedule, by value and by reference.
class WholeFrames : public testing::TestWithParam<std::tuple<std::optional<ScheduleKind>, bool>> {
 protected:
  template <PixelAlgebra A>
  InProcessFrame<typename A::Pixel> composited(
      ImageSize size, const std::vector<Subimage<typename A::Pixel>>& images, int root = 0) {
    const auto& [kind, isSharing] = GetParam();
    CompositeOptions options;
    if (kind) options.schedule = ScheduleOptions{*kind};
    options.packing = Packing::kNever;
    options.isSharingMemory = isSharing;
    options.root = Rank{root};
    auto result =
        compositeInProcess<A>(options, size, inOrder(static_cast<int>(images.size())), images);
    for (const Outcome& outcome : result.outcomes) EXPECT_FALSE(outcome.failed) << outcome.reason;
    return result;
  }
};

/// No two of its pixels are equal.
Image<AffineMap> numberedPixels(ImageSize size) {
  Image<AffineMap> picture{size};
  for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
    picture.pixels()[i] = {static_cast<std::uint32_t>(3 + 2 * i), static_cast<std::uint32_t>(i)};
  }
  return picture;
}

Subimage<AffineMap> cutOut(const Image<AffineMap>& picture, const PixelRect& rect) {
  Subimage<AffineMap> part{picture.size(), rect, {}};
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < rect.x1; ++x) part.pixels.push_back(picture.at(x, y));
  }
  return part;
}

// Every rank has every Pth pixel, so that ranks meet in every tile: tiles are shuffled among owners
// and each pixel must come back to its place, once.
TEST_P(WholeFrames, InterlacedPixelsComeBackToTheirPlaces) {
  for (const ImageSize size : {ImageSize{1, 1}, ImageSize{131, 67}, ImageSize{997, 1}}) {
    const auto picture = numberedPixels(size);
    for (const int ranks : {1, 2, 3, 6, 7, 13}) {
      const PixelRect whole{0, 0, size.width, size.height};
      std::vector<Subimage<AffineMap>> images(static_cast<std::size_t>(ranks),
                                              cutOut(picture, whole));
      for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
        for (std::size_t rank = 0; rank < images.size(); ++rank) {
          if (i % images.size() != rank) images[rank].pixels[i] = Affine::identity();
        }
      }
      const auto result = composited<Affine>(size, images, ranks - 1);
      EXPECT_TRUE(test::areEqual(result.frame, picture)) << ranks << " ranks";
      std::vector<std::uint32_t> tiles = result.plan.assignment.tiles;
      std::ranges::sort(tiles);
      for (std::size_t tile = 0; tile < tiles.size(); ++tile) EXPECT_EQ(tiles[tile], tile);
      EXPECT_EQ(tiles.size(), result.plan.grid.count());
    }
  }
}

// Bands whose borders lie anywhere in tiles.
TEST_P(WholeFrames, SplitPictureIsWholeAgain) {
  const ImageSize size{263, 97};
  const auto picture = numberedPixels(size);
  for (const int ranks : {1, 2, 3, 5, 16}) {
    for (const bool isUpright : {false, true}) {
      const auto cuts =
          evenCuts(static_cast<std::size_t>(isUpright ? size.width : size.height), ranks);
      std::vector<Subimage<AffineMap>> images;
      for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const auto begin = static_cast<int>(cuts[i]);
        const auto end = static_cast<int>(cuts[i + 1]);
        images.push_back(cutOut(picture, isUpright ? PixelRect{begin, 0, end, size.height}
                                                   : PixelRect{0, begin, size.width, end}));
      }
      const auto result = composited<Affine>(size, images);
      EXPECT_TRUE(test::areEqual(result.frame, picture)) << ranks << " ranks";
    }
  }
}

// Each side of the active rectangles touches the frame's border or does not.
TEST_P(WholeFrames, RectanglesLieAnywhere) {
  const ImageSize size{157, 43};
  for (int touches = 0; touches < 16; ++touches) {
    test::Random random{static_cast<unsigned>(touches)};
    std::vector<Subimage<AffineMap>> images;
    for (int rank = 0; rank < 5; ++rank) {
      const auto inside = [&](int side, int border, int low, int high) {
        const bool isTouching = ((touches >> side) & 1) != 0 && rank != 2;
        return isTouching ? border : low + test::below(random, high - low);
      };
      const PixelRect rect{inside(0, 0, 1, 70), inside(1, 0, 1, 20),
                           inside(2, size.width, 71, size.width),
                           inside(3, size.height, 21, size.height)};
      images.push_back(test::randomSubimage<Affine>(size, rect, random));
    }
    EXPECT_TRUE(test::areEqual(composited<Affine>(size, images, touches % 5).frame,
                               test::combineSerially<Affine>(size, images)))
        << touches;
  }
}

// A background is put behind the finished frame, or drawn by a rank at the back: the same picture,
// which covers every pixel.
TEST_P(WholeFrames, ColouredBackground) {
  const ImageSize size{173, 61};
  const Rgba background{0.25f, 0.5f, 0.75f, 1};
  for (const int ranks : {1, 3, 5, 8}) {
    auto images = test::randomSubimages<Over>(size, ranks, static_cast<unsigned>(ranks));
    Image<Rgba> behind = composited<Over>(size, images).frame;
    for (Rgba& pixel : behind.pixels()) pixel = over(pixel, background);

    images.push_back({size, {0, 0, size.width, size.height}, {}});
    images.back().pixels.resize(size.pixels(), background);
    const auto drawn = composited<Over>(size, images, ranks).frame;
    EXPECT_LE(test::largestDifference(behind, drawn), test::overTolerance(ranks + 1));
    const auto serial = test::combineSerially<Over>(size, images);
    EXPECT_LE(test::largestDifference(serial, drawn), test::overTolerance(ranks + 1));
    for (const Rgba& pixel : drawn.pixels()) {
      ASSERT_NEAR(pixel.a, 1, test::overTolerance(ranks + 1));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    , WholeFrames,
    testing::Combine(testing::Values(std::optional<ScheduleKind>{}, ScheduleKind::kBinarySwap,
                                     ScheduleKind::kRadixK, ScheduleKind::kDirectSend,
                                     ScheduleKind::kSerialGather),
                     testing::Bool()));

}  // namespace
}  // namespace burin::compositor
