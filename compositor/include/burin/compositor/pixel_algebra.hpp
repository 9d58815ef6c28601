#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "burin/common/image.hpp"

namespace burin::compositor {

/// What the compositor needs to know of a pixel.
/// - `combine(front, back)` must be associative, with `identity()` on either side changing nothing;
///   it need not be commutative.
/// - `store` writes a pixel's form on the wire to the start of `out` (which has kMaxWireBytes or
///   more) and returns its length; `load` reads it back from the start of `in`, which may hold
///   anything, and returns the length or 0 if that is no pixel. What arrives is what is combined,
///   so a lossy wire form is allowed. Lengths lie in kMinWireBytes … kMaxWireBytes.
/// - kWireIsMemory: the wire form is the pixel's own bytes and any bytes are a pixel; then runs are
///   copied whole.
template <typename A>
concept PixelAlgebra = std::is_trivially_copyable_v<typename A::Pixel> &&
    std::equality_comparable<typename A::Pixel> &&
    requires(const typename A::Pixel& pixel, typename A::Pixel& into, std::span<std::byte> out,
             std::span<const std::byte> in) {
  { A::identity() } -> std::same_as<typename A::Pixel>;
  { A::combine(pixel, pixel) } -> std::same_as<typename A::Pixel>;
  { A::isIdentity(pixel) } -> std::same_as<bool>;
  { A::store(pixel, out) } -> std::same_as<std::size_t>;
  { A::load(in, into) } -> std::same_as<std::size_t>;
  { A::kMinWireBytes } -> std::convertible_to<std::size_t>;
  { A::kMaxWireBytes } -> std::convertible_to<std::size_t>;
  { A::kWireIsMemory } -> std::convertible_to<bool>;
};

/// The wire part of an algebra whose pixels travel as they lie in memory.
template <typename T>
struct WireIsMemory {
  static_assert(std::is_trivially_copyable_v<T>);
  static constexpr std::size_t kMinWireBytes = sizeof(T);
  static constexpr std::size_t kMaxWireBytes = sizeof(T);
  static constexpr bool kWireIsMemory = true;
  static std::size_t store(const T& pixel, std::span<std::byte> out) {
    std::memcpy(out.data(), &pixel, sizeof(T));
    return sizeof(T);
  }
  static std::size_t load(std::span<const std::byte> in, T& into) {
    if (in.size() < sizeof(T)) return 0;
    std::memcpy(&into, in.data(), sizeof(T));
    return sizeof(T);
  }
};

/// Premultiplied linear RGBA in float, front over back; float on the wire.
/// Porter & Duff, "Compositing Digital Images", SIGGRAPH 1984.
struct Over : WireIsMemory<Rgba> {
  using Pixel = Rgba;
  static constexpr Rgba identity() { return {}; }
  static constexpr Rgba combine(const Rgba& front, const Rgba& back) { return over(front, back); }
  /// All bits zero: light without opacity (r > 0, a = 0) is additive, not nothing.
  static constexpr bool isIdentity(const Rgba& pixel) {
    const auto words = std::bit_cast<std::array<std::uint64_t, 2>>(pixel);
    return (words[0] | words[1]) == 0;
  }
};
static_assert(PixelAlgebra<Over>);

}  // namespace burin::compositor
