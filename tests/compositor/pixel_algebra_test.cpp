#include "burin/compositor/pixel_algebra.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "test_images.hpp"

namespace burin::compositor {
namespace {

using test::randomPixel;

// Each over rounds three times, |error| <= 3u with u = 2^-24 for channels in [0, 1].
// (f over b) over c: the inner error enters the colour (3u) and the opacity (3u), then 3u: 9u.
// f over (b over c): the inner error is scaled by 1 - a_f <= 1, then 3u: 6u. Together 15u.
constexpr float kAssociativityBound = 15.0f * 0x1p-24f;

TEST(Over, IsAssociativeToRounding) {
  test::Random random{1};
  for (int trial = 0; trial < 20'000; ++trial) {
    const Rgba f = randomPixel(Over{}, random);
    const Rgba b = randomPixel(Over{}, random);
    const Rgba c = randomPixel(Over{}, random);
    const Rgba left = Over::combine(Over::combine(f, b), c);
    const Rgba right = Over::combine(f, Over::combine(b, c));
    for (const float d : {left.r - right.r, left.g - right.g, left.b - right.b, left.a - right.a}) {
      ASSERT_LE(std::abs(d), kAssociativityBound);
    }
  }
}

TEST(Over, IdentityChangesNothingOnEitherSide) {
  test::Random random{2};
  EXPECT_TRUE(Over::isIdentity(Over::identity()));
  for (int trial = 0; trial < 20'000; ++trial) {
    Rgba pixel = randomPixel(Over{}, random);
    if (trial == 0) pixel = {1, 1, 1, 1};
    if (trial == 1) pixel = {std::numeric_limits<float>::denorm_min(), 0, 0, 0};
    EXPECT_EQ(Over::combine(Over::identity(), pixel), pixel);
    EXPECT_EQ(Over::combine(pixel, Over::identity()), pixel);
    EXPECT_FALSE(Over::isIdentity(pixel));
  }
}

TEST(Over, OpaqueFrontHidesTheBack) {
  test::Random random{3};
  const Rgba front{0.25f, 0.5f, 1.0f, 1.0f};
  EXPECT_EQ(Over::combine(front, randomPixel(Over{}, random)), front);
}

template <typename A>
class WireForm : public testing::Test {};
using Algebras = testing::Types<Over, test::Affine>;
TYPED_TEST_SUITE(WireForm, Algebras);

TYPED_TEST(WireForm, ComesBackUnchanged) {
  using A = TypeParam;
  test::Random random{4};
  for (int trial = 0; trial < 1000; ++trial) {
    const auto pixel = randomPixel(A{}, random);
    std::array<std::byte, A::kWireBytes> bytes;
    A::store(pixel, bytes);
    EXPECT_EQ(A::load(bytes), pixel);
  }
}

}  // namespace
}  // namespace burin::compositor
