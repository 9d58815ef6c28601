#pragma once

#include <cstdint>

#include "burin/compositor/pixel_algebra.hpp"
#include "random_pixels.hpp"

namespace burin::compositor::test {

struct AffineMap {
  std::uint32_t scale = 0, shift = 0;
  friend bool operator==(const AffineMap&, const AffineMap&) = default;
};

/// Affine maps v -> scale v + shift of 32-bit integers under composition: exactly associative, not
/// commutative, and with an identity that is not all zeros. So any order of combining that keeps
/// visibility order gives equal pixels, and any that does not gives different ones.
struct Affine : WireIsMemory<AffineMap> {
  using Pixel = AffineMap;
  static constexpr Pixel identity() { return {1, 0}; }
  static constexpr Pixel combine(const Pixel& front, const Pixel& back) {
    return {front.scale * back.scale, front.shift + front.scale * back.shift};
  }
  static constexpr bool isIdentity(const Pixel& pixel) { return pixel == identity(); }
};
static_assert(PixelAlgebra<Affine>);

inline AffineMap randomPixel(const Affine&, Random& random) {
  return {2 * static_cast<std::uint32_t>(random()) + 3, static_cast<std::uint32_t>(random())};
}

}  // namespace burin::compositor::test
