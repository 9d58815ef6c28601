#include <gtest/gtest.h>

#include "random_pixels.hpp"

// maximum.hpp and nearest.hpp: the same rule on opposite keys.

namespace burin::compositor {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr Rgba kRed{1, 0, 0, 1};
constexpr Rgba kBlue{0, 0, 1, 1};

TEST(Maximum, LargerValueWinsWhereverItLies) {
  EXPECT_EQ(Maximum::combine({1, kRed}, {2, kBlue}), (MaximumPixel{2, kBlue}));
  EXPECT_EQ(Maximum::combine({2, kRed}, {1, kBlue}), (MaximumPixel{2, kRed}));
  EXPECT_EQ(Maximum::combine({-2, kRed}, {-1, kBlue}), (MaximumPixel{-1, kBlue}));
  EXPECT_EQ(Maximum::combine({kInfinity, kRed}, {1, kBlue}), (MaximumPixel{kInfinity, kRed}));
}

TEST(Maximum, TiesKeepTheFront) {
  EXPECT_EQ(Maximum::combine({1, kRed}, {1, kBlue}).colour, kRed);
  EXPECT_EQ(Maximum::combine({-0.0f, kRed}, {0.0f, kBlue}).colour, kRed);
}

TEST(Nearest, SmallerDepthWinsWhereverItLies) {
  EXPECT_EQ(Nearest::combine({1, kRed}, {2, kBlue}), (NearestPixel{1, kRed}));
  EXPECT_EQ(Nearest::combine({2, kRed}, {1, kBlue}), (NearestPixel{1, kBlue}));
  EXPECT_EQ(Nearest::combine({-kInfinity, kRed}, {1, kBlue}), (NearestPixel{-kInfinity, kRed}));
}

TEST(Nearest, TiesKeepTheFront) {
  EXPECT_EQ(Nearest::combine({1, kRed}, {1, kBlue}).colour, kRed);
  EXPECT_EQ(Nearest::combine({0.0f, kRed}, {-0.0f, kBlue}).colour, kRed);
}

template <typename A>
class WinnerTakesAll : public testing::Test {};
using ExclusiveAlgebras = testing::Types<Maximum, Nearest>;
TYPED_TEST_SUITE(WinnerTakesAll, ExclusiveAlgebras);

TYPED_TEST(WinnerTakesAll, NothingLosesWhateverItsColourIs) {
  using A = TypeParam;
  const float nothing = std::is_same_v<A, Maximum> ? -kInfinity : kInfinity;
  for (const float key : {nothing, kNan, -kNan}) {
    EXPECT_TRUE(A::isIdentity({key, kRed}));
    for (const float number : {0.0f, -nothing, 3e38f, -3e38f}) {
      EXPECT_EQ(A::combine({key, kRed}, {number, kBlue}).colour, kBlue);
      EXPECT_EQ(A::combine({number, kBlue}, {key, kRed}).colour, kBlue);
    }
  }
}

// Any bytes may arrive, so any keys must group alike: the same pixel, or nothing both times.
TYPED_TEST(WinnerTakesAll, IsAssociativeForAllKeysThatMayArrive) {
  using A = TypeParam;
  using Pixel = typename A::Pixel;
  const std::array keys{kNan, -kInfinity, -1.0f, -0.0f, 0.0f, 1.0f, kInfinity};
  for (const float f : keys) {
    for (const float m : keys) {
      for (const float b : keys) {
        const Pixel front{f, {1, 0, 0, 1}};
        const Pixel middle{m, {0, 1, 0, 1}};
        const Pixel back{b, {0, 0, 1, 1}};
        const Pixel left = A::combine(A::combine(front, middle), back);
        const Pixel right = A::combine(front, A::combine(middle, back));
        if (A::isIdentity(left)) {
          EXPECT_TRUE(A::isIdentity(right));
        } else {
          EXPECT_EQ(left, right) << f << ' ' << m << ' ' << b;
        }
      }
    }
  }
}

}  // namespace
}  // namespace burin::compositor
