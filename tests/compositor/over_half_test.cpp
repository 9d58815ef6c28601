#include "burin/compositor/over_half.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "random_pixels.hpp"

namespace burin::compositor {
namespace {

using Exact = std::array<double, 4>;

Exact exactOver(const std::vector<Rgba>& pixels) {
  Exact sum{};
  for (const Rgba& p : pixels) {
    const double through = 1.0 - sum[3];
    const std::array channels{p.r, p.g, p.b, p.a};
    for (std::size_t c = 0; c < 4; ++c) sum[c] += through * static_cast<double>(channels[c]);
  }
  return sum;
}

Rgba crossed(const Rgba& pixel) {
  std::array<std::byte, OverHalf::kMaxWireBytes> bytes{};
  Rgba arrived;
  OverHalf::store(pixel, bytes);
  OverHalf::load(bytes, arrived);
  return arrived;
}

// A tree of pairs in which every partial picture crosses the wire before each combination: the
// worst that binary swap can do.
TEST(OverHalf, ErrorGrowsWithCrossingsAndNotWithRanks) {
  test::Random random{1};
  for (int trial = 0; trial < 3000; ++trial) {
    const float faintness = test::unit(random);
    std::vector<Rgba> pixels(1u << test::below(random, 8));
    for (Rgba& p : pixels) {
      const Rgba q = test::randomPixel(Over{}, random);
      p = {faintness * q.r, faintness * q.g, faintness * q.b, faintness * q.a};
    }
    const Exact exact = exactOver(pixels);
    const auto ranks = static_cast<double>(pixels.size());
    int crossings = 0;
    for (; pixels.size() > 1; ++crossings) {
      std::vector<Rgba> combined;
      for (std::size_t i = 0; i < pixels.size(); i += 2) {
        combined.push_back(OverHalf::combine(crossed(pixels[i]), crossed(pixels[i + 1])));
      }
      pixels = std::move(combined);
    }
    const Rgba result = crossed(pixels[0]);  // the gather
    ++crossings;
    // over_half.hpp's bound; higher orders add less than 1 % here; float's own rounding.
    const double rest =
        crossings * ranks * 0x1p-25 + double{test::overTolerance(static_cast<int>(ranks))};
    const double opacityBound = 1.01 * crossings * 0x1p-11 + rest;
    const double colourBound = 1.01 * crossings * 0x1p-10 + rest;
    EXPECT_LE(std::abs(double{result.a} - exact[3]), opacityBound);
    EXPECT_LE(std::abs(double{result.r} - exact[0]), colourBound);
    EXPECT_LE(std::abs(double{result.g} - exact[1]), colourBound);
    EXPECT_LE(std::abs(double{result.b} - exact[2]), colourBound);
  }
}

TEST(OverHalf, ColourNeverExceedsOpacityByTravelling) {
  test::Random random{2};
  for (int trial = 0; trial < 100'000; ++trial) {
    const Rgba p = crossed(test::randomPixel(Over{}, random));
    ASSERT_LE(std::max({p.r, p.g, p.b}), p.a);
  }
}

TEST(OverHalf, OpaqueStaysOpaqueAndNothingNothing) {
  EXPECT_EQ(crossed({0.5f, 0.25f, 1, 1}), (Rgba{0.5f, 0.25f, 1, 1}));
  EXPECT_EQ(crossed({}), Rgba{});
  EXPECT_EQ(crossed({1e6f, 0, 0, 1}), (Rgba{65504, 0, 0, 1}));
  EXPECT_EQ(OverHalf::kMaxWireBytes, 8u);
}

}  // namespace
}  // namespace burin::compositor
