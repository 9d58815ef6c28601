#include "burin/common/zstd_codec.hpp"

#include <gtest/gtest.h>

#include <random>

namespace burin {
namespace {

std::vector<std::byte> randomBytes(std::size_t count, int distinct, unsigned seed) {
  std::mt19937 random{seed};
  std::uniform_int_distribution<int> value{0, distinct - 1};
  std::vector<std::byte> bytes(count);
  for (auto& b : bytes) b = static_cast<std::byte>(value(random));
  return bytes;
}

TEST(ZstdCodec, RoundTrip) {
  for (const std::size_t size : {0U, 1U, 7U, 4096U, 300'000U}) {
    for (const int distinct : {1, 3, 256}) {
      const auto raw = randomBytes(size, distinct, 1);
      const auto back = decompressZstd(compressZstd(raw), size);
      ASSERT_TRUE(back.has_value()) << size << " bytes of " << distinct;
      EXPECT_EQ(*back, raw);
    }
  }
}

TEST(ZstdCodec, CompressesWhatRepeats) {
  EXPECT_LT(compressZstd(std::vector<std::byte>(100'000)).size(), 1000U);
}

TEST(ZstdCodec, RefusesMoreThanTheBound) {
  const auto packed = compressZstd(randomBytes(1000, 4, 2));
  EXPECT_TRUE(decompressZstd(packed, 1000).has_value());
  EXPECT_FALSE(decompressZstd(packed, 999).has_value());
  EXPECT_FALSE(decompressZstd(packed, 0).has_value());
}

TEST(ZstdCodec, RefusesEveryTruncation) {
  const auto packed = compressZstd(randomBytes(500, 4, 3));
  for (std::size_t size = 0; size < packed.size(); ++size) {
    EXPECT_FALSE(decompressZstd(std::span{packed}.first(size), 1000).has_value()) << size;
  }
}

TEST(ZstdCodec, RefusesTrailingBytesAndSecondFrames) {
  auto packed = compressZstd(randomBytes(500, 4, 4));
  packed.push_back(std::byte{0});
  EXPECT_FALSE(decompressZstd(packed, 1000).has_value());
  packed.pop_back();
  const auto empty = compressZstd({});
  packed.insert(packed.end(), empty.begin(), empty.end());
  EXPECT_FALSE(decompressZstd(packed, 1000).has_value());
}

// The frame's checksum finds what the entropy coder lets pass: no flipped bit yields other bytes.
TEST(ZstdCodec, NeverReturnsDamagedBytes) {
  const auto raw = randomBytes(600, 6, 5);
  const auto packed = compressZstd(raw);
  std::size_t refused = 0;
  for (std::size_t bit = 0; bit < 8 * packed.size(); ++bit) {
    auto damaged = packed;
    damaged[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    const auto back = decompressZstd(damaged, raw.size());
    if (!back.has_value()) {
      ++refused;
    } else {
      EXPECT_EQ(*back, raw) << "bit " << bit;  // a bit of the header that carries no meaning
    }
  }
  EXPECT_GE(refused, 8 * packed.size() - 8);
}

TEST(ZstdCodec, RefusesNoise) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    EXPECT_FALSE(decompressZstd(randomBytes(seed, 256, seed), 1 << 20).has_value()) << seed;
  }
}

}  // namespace
}  // namespace burin
