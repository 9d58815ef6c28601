#include "burin/host/srgb_encoder.hpp"

#include "burin/common/colour.hpp"

namespace burin::host {

SrgbEncoder::SrgbEncoder() {
  for (std::size_t k = 0; k < 256; ++k)
    light_[k] = static_cast<float>(linearFromSrgb(static_cast<double>(k) / 255));
  for (std::size_t k = 0; k < 255; ++k) codesPerLight_[k] = 1.0f / (light_[k + 1] - light_[k]);
  std::size_t code = 0;
  for (std::size_t cell = 0; cell <= kCells; ++cell) {
    const float start = static_cast<float>(cell) / kCells;
    while (code < 255 && light_[code + 1] <= start) ++code;
    firstCode_[cell] = static_cast<std::uint8_t>(code);
  }
}

std::uint8_t SrgbEncoder::encode(float linear, float threshold) const {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  // The curve rises by at most 12.92 * 255 / 4096 < 1 code per cell, so this looks one or two
  // ahead.
  std::size_t code = firstCode_[static_cast<std::size_t>(linear * kCells)];
  while (linear >= light_[code + 1]) ++code;
  const float fraction = (linear - light_[code]) * codesPerLight_[code];
  return static_cast<std::uint8_t>(code + (fraction > threshold ? 1 : 0));
}

}  // namespace burin::host
