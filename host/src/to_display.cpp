#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "burin/host/picture.hpp"
#include "burin/host/srgb_encoder.hpp"

namespace burin::host {

namespace {

/// A pixel's thresholds of red, green, blue and alpha: the two-dimensional Kronecker sequence of
/// the plastic number p, x / p + y / p², is even over any neighbourhood of pixels (Roberts 2018,
/// "The unreasonable effectiveness of quasirandom sequences"). Channels are a quarter apart, so
/// that their errors do not add up to a change of brightness. A pixel's place is all that counts:
/// the same frame always gives the same picture.
std::array<float, 4> thresholds(int x, int y) {
  constexpr std::uint32_t kInverse = 3242174889;        // 2^32 / p
  constexpr std::uint32_t kInverseSquare = 2447445414;  // 2^32 / p²
  const std::uint32_t place =
      static_cast<std::uint32_t>(x) * kInverse + static_cast<std::uint32_t>(y) * kInverseSquare;
  std::array<float, 4> result;
  for (std::uint32_t channel = 0; channel < 4; ++channel) {
    const std::uint32_t step = (place + channel * 0x40000000u) >> 24;
    result[channel] = (static_cast<float>(step) + 0.5f) / 256.0f;  // as far from 0 as from 1
  }
  return result;
}

Rgba linearOf(const Colour& colour) {
  const glm::dvec3 linear = colour.linear();
  return {static_cast<float>(linear.r), static_cast<float>(linear.g), static_cast<float>(linear.b),
          1};
}

/// Alpha is linear in its code, 255 per unit.
std::uint8_t encodeAlpha(float alpha, float threshold) {
  const float codes = 255.0f * glm::clamp(alpha, 0.0f, 1.0f);
  return static_cast<std::uint8_t>(codes + 1.0f - threshold);
}

}  // namespace

DisplayPicture toDisplay(ImageView<const Rgba> frame, const std::optional<Colour>& background) {
  static const SrgbEncoder encoder;
  DisplayPicture picture;
  picture.size = frame.size();
  picture.channels = background ? 3 : 4;
  picture.bytes.resize(frame.size().pixels() * static_cast<std::size_t>(picture.channels));
  const Rgba back = background ? linearOf(*background) : Rgba{};
  std::uint8_t* out = picture.bytes.data();
  for (int y = 0; y < frame.size().height; ++y) {
    for (int x = 0; x < frame.size().width; ++x) {
      const std::array<float, 4> threshold = thresholds(x, y);
      const Rgba& pixel = frame.at(x, y);
      Rgba shown = over(pixel, back);
      if (!background) {
        const float straight = pixel.a > 0 ? 1.0f / pixel.a : 0.0f;
        shown = {pixel.r * straight, pixel.g * straight, pixel.b * straight, pixel.a};
      }
      *out++ = encoder.encode(shown.r, threshold[0]);
      *out++ = encoder.encode(shown.g, threshold[1]);
      *out++ = encoder.encode(shown.b, threshold[2]);
      if (!background) *out++ = encodeAlpha(pixel.a, threshold[3]);
    }
  }
  return picture;
}

}  // namespace burin::host
