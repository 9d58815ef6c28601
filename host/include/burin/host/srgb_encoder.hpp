#pragma once

#include <array>
#include <cstdint>

namespace burin::host {

/// Linear light to 8-bit sRGB without a power function per pixel.
class SrgbEncoder {
 public:
  SrgbEncoder();
  /// The code below 255 * srgbFromLinear(x) or the one above: the latter if the fraction between
  /// them is larger than `threshold`, in (0, 1). Over thresholds spread evenly, codes have x's own
  /// mean, to 0.01 code: between two codes the curve is taken as straight. What a code stands for
  /// comes back as that code for thresholds from 1/512 to 1 - 1/512. Clamps to [0, 1]; NaN becomes
  /// 0.
  std::uint8_t encode(float linear, float threshold) const;

 private:
  static constexpr int kCells = 4096;
  std::array<float, 256> light_;                    ///< what each code stands for
  std::array<float, 255> codesPerLight_;            ///< from each code to the next
  std::array<std::uint8_t, kCells + 1> firstCode_;  ///< code at the low end of each cell of [0, 1]
};

}  // namespace burin::host
