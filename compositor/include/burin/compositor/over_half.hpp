#pragma once

#include "burin/compositor/half.hpp"
#include "burin/compositor/pixel_algebra.hpp"

namespace burin::compositor {

/// Over with halves on the wire: float in memory, so only what travels is rounded.
///
/// Error: a crossing changes a channel by at most 2^-11 of its value (half.hpp). In the picture
/// T_i weighs subimage i, T_i = Π (1 - a_j) over those in front of it: an error of its colour
/// arrives times T_i, one of its opacity times T_i and the colour behind it (<= 1). As Σ T_i c_i
/// and Σ T_i a_i are the picture's colour and opacity (<= 1), pixels that cross at most R times
/// leave an opacity within R 2^-11 and a colour within R 2^-10 of the exact ones, to first order
/// and for any number of ranks. Channels below 2^-14 add at most 2^-25 per crossing and rank; one
/// below 2^-25 arrives as 0, so a faint pixel may arrive as the identity.
struct OverHalf {
  using Pixel = Rgba;
  static constexpr std::size_t kMinWireBytes = 4 * sizeof(Half);
  static constexpr std::size_t kMaxWireBytes = kMinWireBytes;
  static constexpr bool kWireIsMemory = false;

  static constexpr Rgba identity() { return Over::identity(); }
  static constexpr Rgba combine(const Rgba& front, const Rgba& back) { return over(front, back); }
  static constexpr bool isIdentity(const Rgba& pixel) { return Over::isIdentity(pixel); }

  static std::size_t store(const Rgba& pixel, std::span<std::byte> out) {
    const std::array halves{toHalf(pixel.r), toHalf(pixel.g), toHalf(pixel.b), toHalf(pixel.a)};
    std::memcpy(out.data(), halves.data(), kMaxWireBytes);
    return kMaxWireBytes;
  }
  static std::size_t load(std::span<const std::byte> in, Rgba& into) {
    if (in.size() < kMaxWireBytes) return 0;
    std::array<Half, 4> halves{};
    std::memcpy(halves.data(), in.data(), kMaxWireBytes);
    into = {toFloat(halves[0]), toFloat(halves[1]), toFloat(halves[2]), toFloat(halves[3])};
    return kMaxWireBytes;
  }
};
static_assert(PixelAlgebra<OverHalf>);

}  // namespace burin::compositor
