#pragma once

#include <limits>

#include "burin/compositor/pixel_algebra.hpp"

namespace burin::compositor {

/// The largest value on a ray; -inf: none.
struct LargestValuePixel {
  float value = -std::numeric_limits<float>::infinity();
  friend bool operator==(const LargestValuePixel&, const LargestValuePixel&) = default;
};

/// Maximum intensity projection whose colour is found when all ranks' values are known. Exactly
/// associative and commutative. NaN is nothing, so any bytes on the wire are a pixel.
struct LargestValue : WireIsMemory<LargestValuePixel> {
  using Pixel = LargestValuePixel;
  static constexpr Pixel identity() { return {}; }
  static constexpr Pixel combine(const Pixel& front, const Pixel& back) {
    return back.value > front.value || isIdentity(front) ? back : front;
  }
  static constexpr bool isIdentity(const Pixel& pixel) {
    return !(pixel.value > -std::numeric_limits<float>::infinity());
  }
};
static_assert(PixelAlgebra<LargestValue>);

}  // namespace burin::compositor
