#pragma once

#include <limits>

#include "burin/compositor/pixel_algebra.hpp"

namespace burin::compositor {

/// The first surface on a ray: its depth and its premultiplied colour.
struct NearestPixel {
  float depth = std::numeric_limits<float>::infinity();
  Rgba colour;
  friend bool operator==(const NearestPixel&, const NearestPixel&) = default;
};

/// Depth-buffered surfaces: the smaller depth wins (distance from the eye in any one unit), and of
/// equal ones the front. Right for pieces that interpenetrate, where no visibility order exists.
/// Exactly associative.
///
/// A depth of +inf or NaN is nothing: such a pixel is the identity whatever its colour, loses
/// against every number, and so any bytes on the wire are a pixel.
struct Nearest : WireIsMemory<NearestPixel> {
  using Pixel = NearestPixel;
  static constexpr Pixel identity() { return {}; }
  static constexpr Pixel combine(const Pixel& front, const Pixel& back) {
    return back.depth < front.depth || isIdentity(front) ? back : front;
  }
  static constexpr bool isIdentity(const Pixel& pixel) {
    return !(pixel.depth < std::numeric_limits<float>::infinity());
  }
};
static_assert(PixelAlgebra<Nearest>);
static_assert(sizeof(NearestPixel) == 5 * sizeof(float), "padding would go onto the wire");

}  // namespace burin::compositor
