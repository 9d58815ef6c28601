#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "burin/host/picture.hpp"
#include "burin/host/srgb_encoder.hpp"

namespace burin::host {

namespace {

void encodeOver(ImageView<const Rgba> frame, const Colour& background, const SrgbEncoder& encoder,
                std::uint8_t* out) {
  const glm::dvec3 linear = background.linear();
  const Rgba back{static_cast<float>(linear.r), static_cast<float>(linear.g),
                  static_cast<float>(linear.b), 1};
  for (const Rgba& pixel : frame.pixels()) {
    const Rgba shown = over(pixel, back);
    *out++ = encoder.encode(shown.r);
    *out++ = encoder.encode(shown.g);
    *out++ = encoder.encode(shown.b);
  }
}

void encodeStraight(ImageView<const Rgba> frame, const SrgbEncoder& encoder, std::uint8_t* out) {
  for (const Rgba& pixel : frame.pixels()) {
    const float unpremultiply = pixel.a > 0 ? 1.0f / pixel.a : 0.0f;
    *out++ = encoder.encode(pixel.r * unpremultiply);
    *out++ = encoder.encode(pixel.g * unpremultiply);
    *out++ = encoder.encode(pixel.b * unpremultiply);
    *out++ = static_cast<std::uint8_t>(std::lround(std::clamp(pixel.a, 0.0f, 1.0f) * 255.0f));
  }
}

}  // namespace

DisplayPicture toDisplay(ImageView<const Rgba> frame, const std::optional<Colour>& background) {
  static const SrgbEncoder encoder;
  DisplayPicture picture;
  picture.size = frame.size();
  picture.channels = background ? 3 : 4;
  picture.bytes.resize(frame.size().pixels() * static_cast<std::size_t>(picture.channels));
  if (background) {
    encodeOver(frame, *background, encoder, picture.bytes.data());
  } else {
    encodeStraight(frame, encoder, picture.bytes.data());
  }
  return picture;
}

}  // namespace burin::host
