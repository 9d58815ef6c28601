#include "burin/compositor/colour_prediction.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace burin::compositor {

namespace {

using Words = std::array<std::uint32_t, 4>;  // r, g, b, a
constexpr std::size_t kPixelBytes = sizeof(Words);

float asFloat(std::uint32_t word) {
  return std::bit_cast<float>(word);
}

/// base · (before / beforeBase), as bits; nothing where that is no number, whose bits might depend
/// on who computes it.
std::uint32_t inRatio(std::uint32_t base, std::uint32_t before, std::uint32_t beforeBase) {
  const float expected = asFloat(base) * (asFloat(before) / asFloat(beforeBase));
  return std::isfinite(expected) ? std::bit_cast<std::uint32_t>(expected) : 0;
}

/// Small differences of either sign become small numbers.
std::uint32_t folded(std::uint32_t difference) {
  return (difference << 1) ^ (0U - (difference >> 31));
}
std::uint32_t unfolded(std::uint32_t number) {
  return (number >> 1) ^ (0U - (number & 1));
}

template <typename Step>
void forEachPixel(std::span<const std::byte> in, std::span<std::byte> out, Step&& step) {
  Words before{};
  std::size_t at = 0;
  for (; at + kPixelBytes <= in.size(); at += kPixelBytes) {
    Words words;
    std::memcpy(words.data(), in.data() + at, kPixelBytes);
    const Words result = step(words, before);
    std::memcpy(out.data() + at, result.data(), kPixelBytes);
  }
  std::ranges::copy(in.subspan(at), out.begin() + static_cast<std::ptrdiff_t>(at));
}

}  // namespace

void predictColours(std::span<const std::byte> in, std::span<std::byte> out) {
  forEachPixel(in, out, [](const Words& pixel, Words& before) {
    const Words difference{folded(pixel[0] - inRatio(pixel[3], before[0], before[3])),
                           folded(pixel[1] - inRatio(pixel[0], before[1], before[0])),
                           folded(pixel[2] - inRatio(pixel[0], before[2], before[0])),
                           folded(pixel[3] - before[3])};
    before = pixel;
    return difference;
  });
}

void restoreColours(std::span<const std::byte> in, std::span<std::byte> out) {
  forEachPixel(in, out, [](const Words& difference, Words& before) {
    Words pixel{};
    pixel[3] = before[3] + unfolded(difference[3]);
    pixel[0] = inRatio(pixel[3], before[0], before[3]) + unfolded(difference[0]);
    pixel[1] = inRatio(pixel[0], before[1], before[0]) + unfolded(difference[1]);
    pixel[2] = inRatio(pixel[0], before[2], before[0]) + unfolded(difference[2]);
    before = pixel;
    return pixel;
  });
}

}  // namespace burin::compositor
