#include "burin/compositor/pixel_algebra.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "affine.hpp"
#include "random_pixels.hpp"

// What the concept promises, of every algebra with random elements; what an algebra means is tested
// in the file named after it.

namespace burin::compositor {
namespace {

using test::agree;
using test::randomPixel;

constexpr int kTrials = 20'000;

template <typename A>
class EveryAlgebra : public testing::Test {};
using Algebras =
    testing::Types<test::Affine, Over, OverHalf, Maximum, LargestValue, WeightedSum, Nearest,
                   Silhouette, SilhouetteDepth, FlatRecords<1>, FlatRecords<4>, FlatRecords<9>,
                   FlatRecords<32>, Product<Channel<"beauty", Over>, Channel<"first", Nearest>>,
                   Product<Channel<"silhouette", Silhouette>, Channel<"beauty", Over>,
                           Channel<"flat", FlatRecords<3>>>>;
TYPED_TEST_SUITE(EveryAlgebra, Algebras);

TYPED_TEST(EveryAlgebra, IsAssociative) {
  using A = TypeParam;
  test::Random random{1};
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto f = randomPixel(A{}, random);
    const auto m = randomPixel(A{}, random);
    const auto b = randomPixel(A{}, random);
    const auto left = A::combine(A::combine(f, m), b);
    const auto right = A::combine(f, A::combine(m, b));
    ASSERT_TRUE(agree(A{}, left, right, 3)) << "trial " << trial;
  }
}

TYPED_TEST(EveryAlgebra, IdentityChangesNothingOnEitherSide) {
  using A = TypeParam;
  test::Random random{2};
  EXPECT_TRUE(A::isIdentity(A::identity()));
  for (int trial = 0; trial < kTrials; ++trial) {
    const auto pixel = randomPixel(A{}, random);
    ASSERT_EQ(A::combine(A::identity(), pixel), pixel);
    ASSERT_EQ(A::combine(pixel, A::identity()), pixel);
    ASSERT_EQ(A::isIdentity(pixel), pixel == A::identity());
  }
}

/// The pixel as it arrives. `bytes` are exactly those stored: nothing else is written.
template <typename A>
typename A::Pixel sent(const typename A::Pixel& pixel, std::vector<std::byte>& bytes) {
  bytes.assign(A::kMaxWireBytes + 1, std::byte{0xa5});
  const std::size_t length = A::store(pixel, bytes);
  EXPECT_GE(length, A::kMinWireBytes);
  EXPECT_LE(length, A::kMaxWireBytes);
  for (std::size_t i = length; i < bytes.size(); ++i) EXPECT_EQ(bytes[i], std::byte{0xa5});
  bytes.resize(length);
  bytes.shrink_to_fit();  // so that the address sanitizer sees a read beyond
  auto arrived = A::identity();
  EXPECT_EQ(A::load(bytes, arrived), length);
  return arrived;
}

TYPED_TEST(EveryAlgebra, ComesBackFromTheWireAndThenUnchanged) {
  using A = TypeParam;
  test::Random random{3};
  std::vector<std::byte> bytes;
  std::vector<std::byte> again;
  for (int trial = 0; trial < kTrials / 10; ++trial) {
    const auto pixel = trial == 0 ? A::identity() : randomPixel(A{}, random);
    const auto arrived = sent<A>(pixel, bytes);
    const bool isExact = !std::is_same_v<A, OverHalf>;
    EXPECT_TRUE(arrived == pixel || !isExact);
    EXPECT_EQ(sent<A>(arrived, again), arrived);
    EXPECT_EQ(again, bytes);
  }
}

TYPED_TEST(EveryAlgebra, CutShortIsNoPixel) {
  using A = TypeParam;
  test::Random random{4};
  std::vector<std::byte> bytes;
  for (int trial = 0; trial < 100; ++trial) {
    sent<A>(randomPixel(A{}, random), bytes);
    while (!bytes.empty()) {
      bytes.pop_back();
      bytes.shrink_to_fit();
      auto pixel = A::identity();
      ASSERT_EQ(A::load(bytes, pixel), 0u) << bytes.size();
    }
  }
}

TYPED_TEST(EveryAlgebra, AnyBytesAreNoPixelOrOneThatCanBeUsed) {
  using A = TypeParam;
  test::Random random{5};
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<std::byte> bytes(
        static_cast<std::size_t>(test::below(random, static_cast<int>(A::kMaxWireBytes) + 1)));
    // Small numbers more often, or few lengths and codes would be valid.
    const unsigned shift = random() % 8;
    for (std::byte& b : bytes) b = static_cast<std::byte>((random() & 0xffu) >> shift);
    auto pixel = A::identity();
    const std::size_t length = A::load(bytes, pixel);
    const bool isPixel = A::kWireIsMemory && bytes.size() >= sizeof(pixel);
    ASSERT_TRUE(length == sizeof(pixel) || !isPixel);
    if (length == 0) continue;
    ASSERT_GE(length, A::kMinWireBytes);
    ASSERT_LE(length, bytes.size());
    std::vector<std::byte> stored(A::kMaxWireBytes);
    ASSERT_EQ(A::store(A::combine(A::identity(), pixel), stored), length);
  }
}

TYPED_TEST(EveryAlgebra, WireIsMemoryMeansTheSameBytes) {
  using A = TypeParam;
  if (!A::kWireIsMemory) return;
  ASSERT_EQ(A::kMinWireBytes, sizeof(typename A::Pixel));
  ASSERT_EQ(A::kMaxWireBytes, sizeof(typename A::Pixel));
  test::Random random{6};
  for (int trial = 0; trial < 100; ++trial) {
    const auto pixel = randomPixel(A{}, random);
    std::vector<std::byte> bytes(A::kMaxWireBytes);
    A::store(pixel, bytes);
    EXPECT_TRUE(std::ranges::equal(bytes, std::as_bytes(std::span{&pixel, 1})));
  }
}

TYPED_TEST(EveryAlgebra, PaddingDoesNotReachTheWire) {
  using A = TypeParam;
  using Pixel = typename A::Pixel;
  test::Random random{7};
  // Wherever the pixel's bytes are not its value, changing them must not show. A byte is part of
  // the value if equality or what is stored notices it, so the two must notice the same bytes.
  for (int trial = 0; trial < 100; ++trial) {
    const Pixel pixel = randomPixel(A{}, random);
    std::vector<std::byte> stored(A::kMaxWireBytes);
    A::store(pixel, stored);
    for (std::size_t i = 0; i < sizeof(Pixel); ++i) {
      auto bytes = std::bit_cast<std::array<std::byte, sizeof(Pixel)>>(pixel);
      bytes[i] ^= std::byte{1};
      Pixel other;
      std::memcpy(&other, bytes.data(), sizeof(Pixel));
      if (!(other == pixel)) continue;
      std::vector<std::byte> otherStored(A::kMaxWireBytes);
      A::store(other, otherStored);
      ASSERT_EQ(otherStored, stored) << "byte " << i;
    }
  }
}

TEST(Over, FaintLightIsSomething) {
  constexpr float kFaintest = std::numeric_limits<float>::denorm_min();
  for (const Rgba& pixel : {Rgba{kFaintest, 0, 0, 0}, Rgba{0, 0, 0, kFaintest}, Rgba{1, 1, 1, 1}}) {
    EXPECT_FALSE(Over::isIdentity(pixel));
    EXPECT_EQ(Over::combine(Over::identity(), pixel), pixel);
    EXPECT_EQ(Over::combine(pixel, Over::identity()), pixel);
  }
}

TEST(Over, OpaqueFrontHidesTheBack) {
  test::Random random{8};
  const Rgba front{0.25f, 0.5f, 1.0f, 1.0f};
  EXPECT_EQ(Over::combine(front, randomPixel(Over{}, random)), front);
}

}  // namespace
}  // namespace burin::compositor
