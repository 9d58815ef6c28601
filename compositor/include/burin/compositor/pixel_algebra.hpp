#pragma once

#include <concepts>
#include <cstddef>
#include <cstring>
#include <span>

#include "burin/common/image.hpp"

namespace burin::compositor {

/// What the compositor needs to know of a pixel. `combine` must be associative, with `identity()`
/// on either side changing nothing; it need not be commutative. `store` and `load` turn a pixel
/// into kWireBytes bytes and back; what arrives is what is combined, so a lossy wire form is
/// allowed.
template <typename A>
concept PixelAlgebra = std::equality_comparable<typename A::Pixel> &&
    requires(const typename A::Pixel& pixel, std::span<std::byte, A::kWireBytes> out,
             std::span<const std::byte, A::kWireBytes> in) {
  { A::identity() } -> std::same_as<typename A::Pixel>;
  { A::combine(pixel, pixel) } -> std::same_as<typename A::Pixel>;
  { A::isIdentity(pixel) } -> std::same_as<bool>;
  {A::store(pixel, out)};
  { A::load(in) } -> std::same_as<typename A::Pixel>;
};

/// Premultiplied linear RGBA in float, front over back; float on the wire.
/// Porter & Duff, "Compositing Digital Images", SIGGRAPH 1984.
struct Over {
  using Pixel = Rgba;
  static constexpr std::size_t kWireBytes = sizeof(Rgba);

  static constexpr Rgba identity() { return {}; }
  static constexpr Rgba combine(const Rgba& front, const Rgba& back) { return over(front, back); }
  /// Light without opacity (r > 0, a = 0) is additive, not nothing.
  static constexpr bool isIdentity(const Rgba& pixel) { return pixel == Rgba{}; }
  static void store(const Rgba& pixel, std::span<std::byte, kWireBytes> out) {
    std::memcpy(out.data(), &pixel, kWireBytes);
  }
  static Rgba load(std::span<const std::byte, kWireBytes> in) {
    Rgba pixel;
    std::memcpy(&pixel, in.data(), kWireBytes);
    return pixel;
  }
};
static_assert(PixelAlgebra<Over>);

}  // namespace burin::compositor
