#include "burin/host/srgb_encoder.hpp"

#include <cmath>

#include "burin/common/colour.hpp"

namespace burin::host {

namespace {

/// The smallest float at or above the linear value where code `k` begins.
float lowestOf(int k) {
  if (k == 0) return 0;
  const double edge = linearFromSrgb((k - 0.5) / 255);
  const auto rounded = static_cast<float>(edge);
  return static_cast<double>(rounded) >= edge ? rounded : std::nextafter(rounded, 2.0f);
}

}  // namespace

SrgbEncoder::SrgbEncoder() {
  for (int k = 0; k < 256; ++k) lowest_[static_cast<std::size_t>(k)] = lowestOf(k);
  std::size_t code = 0;
  for (std::size_t cell = 0; cell <= kCells; ++cell) {
    const float start = static_cast<float>(cell) / kCells;
    while (code < 255 && lowest_[code + 1] <= start) ++code;
    firstCode_[cell] = static_cast<std::uint8_t>(code);
  }
}

std::uint8_t SrgbEncoder::encode(float linear) const {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  // The curve rises by at most 12.92 * 255 / 4096 < 1 code per cell, so this looks one or two
  // ahead.
  std::size_t code = firstCode_[static_cast<std::size_t>(linear * kCells)];
  while (code < 255 && linear >= lowest_[code + 1]) ++code;
  return static_cast<std::uint8_t>(code);
}

}  // namespace burin::host
