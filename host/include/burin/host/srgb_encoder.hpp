#pragma once

#include <array>
#include <cstdint>

namespace burin::host {

/// Linear light to 8-bit sRGB, rounded exactly as round(255 * srgbFromLinear(x)) is, without a
/// power function per pixel.
class SrgbEncoder {
 public:
  SrgbEncoder();
  /// Clamps to [0, 1]; NaN becomes 0.
  std::uint8_t encode(float linear) const;

 private:
  static constexpr int kCells = 4096;
  std::array<float, 256> lowest_;  ///< smallest float that rounds to each code
  std::array<std::uint8_t, kCells + 1>
      firstCode_;  ///< code at the lower end of each cell of [0, 1]
};

}  // namespace burin::host
