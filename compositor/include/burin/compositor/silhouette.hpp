#pragma once

#include "burin/compositor/closure.hpp"
#include "burin/compositor/pixel_algebra.hpp"
#include "burin/compositor/silhouette_automaton.hpp"

namespace burin::compositor {

/// Which of the 7 functions a segment of slices is: 0 the identity (no slice), 1 + symbol for one
/// slice, then what these compose to. From 7 on: no such function.
enum class SilhouetteCode : std::uint8_t {};

/// What a segment of slices does: the state after it, by the state before it.
using SilhouetteFunction = std::array<RayState, kRayStates>;

namespace detail {

inline constexpr auto kSilhouetteClosure = [] {
  SilhouetteFunction identity{};
  std::array<SilhouetteFunction, kSliceSymbols> slices{};
  for (std::size_t before = 0; before < kRayStates; ++before) {
    const auto state = static_cast<RayState>(before);
    identity[before] = state;
    for (std::size_t symbol = 0; symbol < kSliceSymbols; ++symbol) {
      slices[symbol][before] = next(state, static_cast<SliceSymbol>(symbol));
    }
  }
  const auto compose = [](const SilhouetteFunction& front, const SilhouetteFunction& back) {
    SilhouetteFunction both{};
    for (std::size_t before = 0; before < kRayStates; ++before) {
      both[before] = back[static_cast<std::size_t>(front[before])];
    }
    return both;
  };
  return closureOf<7>(identity, slices, compose);
}();

}  // namespace detail

/// Nagy & Klein's silhouettes in one byte per pixel: a segment of a ray is the function from the
/// state before it to the state after it, and segments compose exactly. A ray outside a rank's
/// bricks is the identity; an empty run that was skipped inside them is one empty slice, not that.
struct Silhouette {
  using Pixel = SilhouetteCode;
  static constexpr std::size_t kFunctions = detail::kSilhouetteClosure.elements.size();
  static constexpr std::size_t kMinWireBytes = 1;
  static constexpr std::size_t kMaxWireBytes = 1;
  static constexpr bool kWireIsMemory = false;  // codes from kFunctions on are no pixel

  static constexpr Pixel identity() { return {}; }
  static constexpr Pixel combine(Pixel front, Pixel back) {
    return Pixel{detail::kSilhouetteClosure.product[index(front)][index(back)]};
  }
  static constexpr bool isIdentity(Pixel pixel) { return pixel == identity(); }

  static std::size_t store(Pixel pixel, std::span<std::byte> out) {
    out[0] = static_cast<std::byte>(pixel);
    return 1;
  }
  static std::size_t load(std::span<const std::byte> in, Pixel& into) {
    if (in.empty() || std::to_integer<std::size_t>(in[0]) >= kFunctions) return 0;
    into = static_cast<Pixel>(in[0]);
    return 1;
  }

  /// The segment of one slice.
  static constexpr Pixel slice(SliceSymbol symbol) {
    return static_cast<Pixel>(1 + static_cast<unsigned>(symbol));
  }
  static constexpr const SilhouetteFunction& function(Pixel pixel) {
    return detail::kSilhouetteClosure.elements[index(pixel)];
  }
  /// Of a whole ray, with the empty slice behind everything: kEmpty, kFilled or kSilhouette.
  static constexpr RayState finalState(Pixel ray) {
    return next(function(ray)[kStartOfRay], SliceSymbol::kEmpty);
  }
  /// Nothing behind `segment` can change it, whatever lies in front of it.
  static constexpr bool canStop(Pixel segment) { return isFinal(function(segment)[kStartOfRay]); }

 private:
  static constexpr std::size_t index(Pixel pixel) { return static_cast<std::size_t>(pixel); }
};
static_assert(PixelAlgebra<Silhouette>);

}  // namespace burin::compositor
