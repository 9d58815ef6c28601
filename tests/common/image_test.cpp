#include "burin/common/image.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/views.hpp"

namespace burin {
namespace {

using test::Random;

bool inside(const PixelRect& rect, int x, int y) {
  return x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1;
}

TEST(PixelRect, IntersectionAndBoundsByCounting) {
  Random random{50};
  for (int trial = 0; trial < 500; ++trial) {
    const auto rect = [&] {  // some of them empty or turned inside out
      return PixelRect{random.integer(0, 9), random.integer(0, 9), random.integer(0, 9),
                       random.integer(0, 9)};
    };
    const PixelRect a = rect();
    const PixelRect b = rect();
    const PixelRect both = intersection(a, b);
    const PixelRect around = boundingRect(a, b);
    std::size_t pixelsOfA = 0;
    PixelRect smallest{10, 10, 0, 0};
    for (int y = 0; y < 10; ++y) {
      for (int x = 0; x < 10; ++x) {
        const bool inA = inside(a, x, y);
        const bool inB = inside(b, x, y);
        pixelsOfA += inA ? 1 : 0;
        EXPECT_EQ(inside(both, x, y), inA && inB);
        if (!inA && !inB) continue;
        smallest = {std::min(smallest.x0, x), std::min(smallest.y0, y),
                    std::max(smallest.x1, x + 1), std::max(smallest.y1, y + 1)};
      }
    }
    EXPECT_EQ(a.pixels(), pixelsOfA);
    EXPECT_EQ(around, smallest.empty() ? PixelRect{} : smallest);
  }
}

TEST(Over, KnownValues) {
  const Rgba half{0.5f, 0.25f, 0.0f, 0.5f};
  const Rgba back{0.0f, 0.5f, 1.0f, 1.0f};
  EXPECT_EQ(over(half, back), (Rgba{0.5f, 0.5f, 0.5f, 1.0f}));
  EXPECT_EQ(over(Rgba{}, back), back);
  EXPECT_EQ(over(half, Rgba{}), half);
  EXPECT_EQ(over(back, half), back);  // opaque hides
}

TEST(Over, GroupingOnlyRounds) {
  Random random{51};
  // Two applications of three roundings each, of values up to 1, in either grouping: 2 * 6 * 2^-24.
  constexpr float kTolerance = 12 * 0x1p-24f;
  for (int trial = 0; trial < 1000; ++trial) {
    const auto pixel = [&] {
      const auto a = static_cast<float>(random.real(0, 1));
      return Rgba{a * static_cast<float>(random.real(0, 1)), a, a / 2, a};
    };
    const Rgba a = pixel();
    const Rgba b = pixel();
    const Rgba c = pixel();
    const Rgba left = over(over(a, b), c);
    const Rgba right = over(a, over(b, c));
    EXPECT_NEAR(left.r, right.r, kTolerance);
    EXPECT_NEAR(left.g, right.g, kTolerance);
    EXPECT_NEAR(left.b, right.b, kTolerance);
    EXPECT_NEAR(left.a, right.a, kTolerance);
  }
}

TEST(Image, RowsRunTopToBottom) {
  Image<int> image{{3, 2}};
  image.at(2, 0) = 1;
  image.at(0, 1) = 2;
  EXPECT_EQ(image.pixels()[2], 1);
  EXPECT_EQ(image.pixels()[3], 2);
  EXPECT_EQ(image.row(1)[0], 2);
  EXPECT_EQ(image.row(1).size(), 3u);
  EXPECT_EQ(image.pixels().size(), 6u);
}

}  // namespace
}  // namespace burin
