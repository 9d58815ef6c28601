#include "burin/compositor/active_area.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "test_images.hpp"

namespace burin::compositor {
namespace {

using Place = std::pair<int, int>;

TEST(Region, PiecesAreConsecutiveAndEven) {
  for (std::size_t pixels = 0; pixels < 40; ++pixels) {
    for (std::size_t pieces = 1; pieces < 12; ++pieces) {
      const Region all{7, 7 + pixels};
      std::size_t next = all.begin;
      for (std::size_t i = 0; i < pieces; ++i) {
        const Region part = piece(all, i, pieces);
        EXPECT_EQ(part.begin, next);
        EXPECT_GE(part.pixels(), pixels / pieces);
        EXPECT_LE(part.pixels(), (pixels + pieces - 1) / pieces);
        next = part.end;
      }
      EXPECT_EQ(next, all.end);
    }
  }
}

/// The area's pixels by looking at every pixel of the bounds.
std::vector<Place> placesOf(const ActiveArea& area) {
  std::vector<Place> places;
  std::size_t number = 0;
  for (int y = area.bounds.y0; y < area.bounds.y1; ++y) {
    for (int x = area.bounds.x0; x < area.bounds.x1; ++x, ++number) {
      const bool isInRect =
          x >= area.rect.x0 && x < area.rect.x1 && y >= area.rect.y0 && y < area.rect.y1;
      if (isInRect && number >= area.region.begin && number < area.region.end) {
        places.emplace_back(x, y);
      }
    }
  }
  return places;
}

std::vector<Place> visited(const ActiveArea& area) {
  std::vector<Place> places;
  forEachRow(area, [&](int y, RowSpan span, std::size_t first) {
    EXPECT_EQ(first, places.size());
    for (int x = span.x0; x < span.x1; ++x) places.emplace_back(x, y);
  });
  return places;
}

PixelRect shifted(PixelRect r, int dx, int dy) {
  return r.empty() ? r : PixelRect{r.x0 + dx, r.y0 + dy, r.x1 + dx, r.y1 + dy};
}

class RandomAreas : public testing::Test {
 protected:
  ActiveArea next() {
    const ImageSize size{1 + test::below(random_, 7), 1 + test::below(random_, 7)};
    const PixelRect bounds{3, 5, 3 + size.width, 5 + size.height};
    return {bounds, regionOf({0, bounds.pixels()}),
            shifted(test::randomRect(size, random_), bounds.x0, bounds.y0)};
  }
  Region regionOf(const Region& all) {
    const std::size_t a = all.begin + random_() % (all.pixels() + 1);
    const std::size_t b = all.begin + random_() % (all.pixels() + 1);
    return {std::min(a, b), std::max(a, b)};
  }
  test::Random random_{5};
};

TEST_F(RandomAreas, RowsAndCountsMatchALookAtEveryPixel) {
  for (int trial = 0; trial < 5000; ++trial) {
    const ActiveArea area = next();
    const auto expected = placesOf(area);
    ASSERT_EQ(visited(area), expected);
    ASSERT_EQ(area.pixels(), expected.size());
    const auto width = static_cast<std::size_t>(area.bounds.width());
    for (std::size_t number = 0; number <= area.bounds.pixels() + 1; ++number) {
      const auto before = std::ranges::count_if(expected, [&](const Place& p) {
        return static_cast<std::size_t>(p.second - area.bounds.y0) * width +
                   static_cast<std::size_t>(p.first - area.bounds.x0) <
               number;
      });
      ASSERT_EQ(area.pixelsBefore(number), static_cast<std::size_t>(before));
    }
  }
}

TEST_F(RandomAreas, APartHasThePixelsOfItsRegionAndNoBlankRowAtItsEnds) {
  for (int trial = 0; trial < 5000; ++trial) {
    const ActiveArea area = next();
    const Region region = regionOf(area.region);
    const ActiveArea part = area.within(region);
    ASSERT_EQ(placesOf(part), placesOf({area.bounds, region, area.rect}));
    ASSERT_EQ(part.rect.empty(), part.pixels() == 0);
    if (part.rect.empty()) continue;
    EXPECT_GT(part.row(part.rect.y0).pixels(), 0U);
    EXPECT_GT(part.row(part.rect.y1 - 1).pixels(), 0U);
  }
}

}  // namespace
}  // namespace burin::compositor
