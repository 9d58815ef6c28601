#include "burin/compositor/half.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <limits>

#include "random_pixels.hpp"

namespace burin::compositor {
namespace {

/// Independent of bits: rounds value / spacing in double, where both are exact.
float nearestHalf(float value) {
  int exponent = 0;
  std::frexp(value, &exponent);
  const double spacing = std::ldexp(1.0, std::max(exponent - 11, -24));
  const double rounded = std::nearbyint(static_cast<double>(value) / spacing) * spacing;
  return static_cast<float>(std::clamp(rounded, -65504.0, 65504.0));
}

TEST(Half, EveryOneBecomesTheFloatThatGlmSaysAndComesBack) {
  for (unsigned bits = 0; bits <= 0xffffu; ++bits) {
    const auto half = static_cast<Half>(bits);
    const float expected = glm::unpackHalf1x16(static_cast<glm::uint16>(bits));
    if (std::isnan(expected)) {
      EXPECT_TRUE(std::isnan(toFloat(half)));
      EXPECT_TRUE(std::isnan(toFloat(toHalf(expected))));
    } else {
      EXPECT_EQ(toFloat(half), expected);
      EXPECT_EQ(toHalf(expected), half);
    }
  }
}

TEST(Half, AllFloatsGoToTheNearestTiesToEven) {
  test::Random random{1};
  for (int trial = 0; trial < 1'000'000; ++trial) {
    auto bits = static_cast<std::uint32_t>(random());
    if (trial % 4 == 0) bits &= 0xfffff000u;  // ties
    const auto value = std::bit_cast<float>(bits);
    if (!std::isfinite(value)) continue;
    ASSERT_EQ(toFloat(toHalf(value)), nearestHalf(value)) << value;
  }
}

TEST(Half, IsOffByNoMoreThanItSays) {
  test::Random random{2};
  for (int trial = 0; trial < 1'000'000; ++trial) {
    const float value = std::ldexp(test::unit(random), -test::below(random, 32));
    const float bound = value < 0x1p-14f ? 0x1p-25f : value * 0x1p-11f;
    ASSERT_LE(std::abs(toFloat(toHalf(value)) - value), bound) << value;
  }
}

TEST(Half, FiniteOverflowStaysFiniteAndTheRestStaysWhatItIs) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float value :
       {65504.0f, 65505.0f, 65520.0f, 1e30f, std::numeric_limits<float>::max()}) {
    EXPECT_EQ(toFloat(toHalf(value)), kLargestHalf);
    EXPECT_EQ(toFloat(toHalf(-value)), -kLargestHalf);
  }
  EXPECT_EQ(toFloat(toHalf(kInfinity)), kInfinity);
  EXPECT_EQ(toFloat(toHalf(-kInfinity)), -kInfinity);
  EXPECT_TRUE(std::isnan(toFloat(toHalf(std::numeric_limits<float>::quiet_NaN()))));
  EXPECT_TRUE(std::isnan(toFloat(toHalf(std::bit_cast<float>(0x7f800001u)))));
  EXPECT_TRUE(std::signbit(toFloat(toHalf(-0.0f))));
}

}  // namespace
}  // namespace burin::compositor
