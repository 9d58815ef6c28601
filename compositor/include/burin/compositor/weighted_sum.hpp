#pragma once

#include "burin/compositor/pixel_algebra.hpp"

namespace burin::compositor {

/// The values on a ray times their weights, added up, and the weights' sum.
struct WeightedSumPixel {
  float sum = 0;
  float weight = 0;  ///< 0: nothing
  friend bool operator==(const WeightedSumPixel&, const WeightedSumPixel&) = default;
};

/// Mean values: sums of all ranks, which are divided at the end. Commutative; associative up to the
/// rounding of float: n pixels in any grouping are off by at most (n - 1) 2^-24 of the sum of the
/// absolute values.
struct WeightedSum : WireIsMemory<WeightedSumPixel> {
  using Pixel = WeightedSumPixel;
  static constexpr Pixel identity() { return {}; }
  static constexpr Pixel combine(const Pixel& front, const Pixel& back) {
    return {front.sum + back.sum, front.weight + back.weight};
  }
  static constexpr bool isIdentity(const Pixel& pixel) {
    return pixel.sum == 0 && pixel.weight == 0;
  }
};
static_assert(PixelAlgebra<WeightedSum>);
static_assert(sizeof(WeightedSumPixel) == 2 * sizeof(float), "padding would go onto the wire");

}  // namespace burin::compositor
