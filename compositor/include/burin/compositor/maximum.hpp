#pragma once

#include <limits>

#include "burin/compositor/pixel_algebra.hpp"

namespace burin::compositor {

/// The largest value on a ray and its premultiplied colour.
struct MaximumPixel {
  float value = -std::numeric_limits<float>::infinity();
  Rgba colour;
  friend bool operator==(const MaximumPixel&, const MaximumPixel&) = default;
};

/// Maximum intensity projection: every rank brings the largest value on its part of the ray, in
/// data units or in whatever the layer compares, and the colour the transfer function gives it; the
/// larger value wins, and of equal ones the front. Exactly associative.
///
/// A value of -inf or NaN is nothing: such a pixel is the identity whatever its colour, loses
/// against every number, and so any bytes on the wire are a pixel.
struct Maximum : WireIsMemory<MaximumPixel> {
  using Pixel = MaximumPixel;
  static constexpr Pixel identity() { return {}; }
  static constexpr Pixel combine(const Pixel& front, const Pixel& back) {
    return back.value > front.value || isIdentity(front) ? back : front;
  }
  static constexpr bool isIdentity(const Pixel& pixel) {
    return !(pixel.value > -std::numeric_limits<float>::infinity());
  }
};
static_assert(PixelAlgebra<Maximum>);
static_assert(sizeof(MaximumPixel) == 5 * sizeof(float), "padding would go onto the wire");

}  // namespace burin::compositor
