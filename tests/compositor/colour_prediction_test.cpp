#include "burin/compositor/colour_prediction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "burin/common/zstd_codec.hpp"
#include "random_pixels.hpp"

namespace burin::compositor {
namespace {

std::vector<std::byte> restored(const std::vector<std::byte>& bytes) {
  std::vector<std::byte> differences(bytes.size());
  std::vector<std::byte> result(bytes.size());
  predictColours(bytes, differences);
  restoreColours(differences, result);
  return result;
}

// Random bits hold every kind of number: NaN, infinities, denormals, zeros of both signs.
TEST(ColourPrediction, RestoresAnyBits) {
  test::Random random{1};
  for (const std::size_t size : {0U, 1U, 15U, 16U, 17U, 160U, 4101U}) {
    for (int trial = 0; trial < 20; ++trial) {
      std::vector<std::byte> bytes(size);
      for (std::byte& byte : bytes) {
        const auto kind = random() % 4;
        byte = kind == 0   ? std::byte{0}
               : kind == 1 ? std::byte{0x7f}
               : kind == 2 ? std::byte{0xff}
                           : static_cast<std::byte>(random());
      }
      EXPECT_EQ(restored(bytes), bytes);
    }
  }
}

// One hue, an opacity that wanders: three of four numbers are expected up to rounding.
TEST(ColourPrediction, OneHueCostsLittleMoreThanItsOpacity) {
  test::Random random{2};
  std::vector<Rgba> pixels;
  for (int i = 0; i < 20000; ++i) {
    const float a =
        0.5f + 0.4f * std::sin(0.01f * static_cast<float>(i)) + 0.05f * test::unit(random);
    pixels.push_back({0.9f * a, 0.6f * a, 0.3f * a, a});
  }
  const auto raw = std::as_bytes(std::span{pixels});
  std::vector<std::byte> differences(raw.size());
  predictColours(raw, differences);
  std::vector<std::byte> opacities;
  for (std::size_t i = 12; i < raw.size(); i += 16) {
    opacities.insert(opacities.end(), raw.begin() + static_cast<std::ptrdiff_t>(i),
                     raw.begin() + static_cast<std::ptrdiff_t>(i) + 4);
  }
  EXPECT_LT(compressZstd(differences).size(), 2 * compressZstd(opacities).size());
  EXPECT_GT(compressZstd(raw).size(), 2 * compressZstd(opacities).size());
}

}  // namespace
}  // namespace burin::compositor
