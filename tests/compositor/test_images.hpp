#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "burin/compositor/pixel_algebra.hpp"
#include "burin/compositor/subimage.hpp"

namespace burin::compositor::test {

/// Affine maps v -> scale v + shift of 32-bit integers under composition: exactly associative, not
/// commutative, and with an identity that is not all zeros. So any order of combining that keeps
/// visibility order gives equal pixels, and any that does not gives different ones.
struct Affine {
  struct Pixel {
    std::uint32_t scale = 0, shift = 0;
    friend bool operator==(const Pixel&, const Pixel&) = default;
  };
  static constexpr std::size_t kWireBytes = 8;
  static constexpr Pixel identity() { return {1, 0}; }
  static constexpr Pixel combine(const Pixel& front, const Pixel& back) {
    return {front.scale * back.scale, front.shift + front.scale * back.shift};
  }
  static constexpr bool isIdentity(const Pixel& pixel) { return pixel == identity(); }
  static void store(const Pixel& pixel, std::span<std::byte, kWireBytes> out) {
    std::memcpy(out.data(), &pixel, kWireBytes);
  }
  static Pixel load(std::span<const std::byte, kWireBytes> in) {
    Pixel pixel;
    std::memcpy(&pixel, in.data(), kWireBytes);
    return pixel;
  }
};
static_assert(PixelAlgebra<Affine>);

using Random = std::mt19937;

/// Uniform in [0, 1], the same on every platform.
inline float unit(Random& random) {
  return static_cast<float>(random() >> 8) * 0x1p-24f;
}

inline int below(Random& random, int bound) {
  return static_cast<int>(random() % static_cast<unsigned>(bound));
}

inline Rgba randomPixel(const Over&, Random& random) {
  const float a = unit(random);
  return {a * unit(random), a * unit(random), a * unit(random), a};
}

inline Affine::Pixel randomPixel(const Affine&, Random& random) {
  return {2 * static_cast<std::uint32_t>(random()) + 3, static_cast<std::uint32_t>(random())};
}

/// A rectangle in the frame, empty in one of five cases.
inline PixelRect randomRect(ImageSize frame, Random& random) {
  if (below(random, 5) == 0) return {};
  PixelRect rect{below(random, frame.width), below(random, frame.height), 0, 0};
  rect.x1 = rect.x0 + 1 + below(random, frame.width - rect.x0);
  rect.y1 = rect.y0 + 1 + below(random, frame.height - rect.y0);
  return rect;
}

template <PixelAlgebra A>
Subimage<typename A::Pixel> randomSubimage(ImageSize frame, const PixelRect& active,
                                           Random& random) {
  Subimage<typename A::Pixel> image{frame, active, {}};
  for (std::size_t i = 0; i < active.pixels(); ++i) {
    image.pixels.push_back(randomPixel(A{}, random));
  }
  return image;
}

template <PixelAlgebra A>
std::vector<Subimage<typename A::Pixel>> randomSubimages(ImageSize frame, int count,
                                                         unsigned seed) {
  Random random{seed};
  std::vector<Subimage<typename A::Pixel>> images;
  for (int i = 0; i < count; ++i) {
    images.push_back(randomSubimage<A>(frame, randomRect(frame, random), random));
  }
  return images;
}

template <typename Pixel>
PixelRect boundsOf(const std::vector<Subimage<Pixel>>& images) {
  PixelRect bounds;
  for (const auto& image : images) bounds = boundingRect(bounds, image.active);
  return bounds;
}

/// Front to back, one after the other, over whole frames: what every schedule must equal.
template <PixelAlgebra A>
Image<typename A::Pixel> combineSerially(ImageSize frame,
                                         const std::vector<Subimage<typename A::Pixel>>& images) {
  Image<typename A::Pixel> out{frame};
  std::ranges::fill(out.pixels(), A::identity());
  for (const auto& image : images) {
    std::size_t i = 0;
    for (int y = image.active.y0; y < image.active.y1; ++y) {
      for (int x = image.active.x0; x < image.active.x1; ++x) {
        out.at(x, y) = A::combine(out.at(x, y), image.pixels[i++]);
      }
    }
  }
  return out;
}

template <typename Pixel>
bool areEqual(const Image<Pixel>& a, const Image<Pixel>& b) {
  return a.size() == b.size() && std::ranges::equal(a.pixels(), b.pixels());
}

inline float largestDifference(const Image<Rgba>& a, const Image<Rgba>& b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const Rgba& p = a.pixels()[i];
    const Rgba& q = b.pixels()[i];
    for (const float d : {p.r - q.r, p.g - q.g, p.b - q.b, p.a - q.a}) {
      largest = std::max(largest, std::abs(d));
    }
  }
  return largest;
}

/// Between two groupings of `over` over P subimages with channels in [0, 1]. One over rounds three
/// times: |error| <= 3u, u = 2^-24. Across P an opacity is off by <= 3(P-1)u; a colour inherits the
/// front's opacity error too, so <= 1.5 P(P-1)u to first order; two groupings: twice that.
constexpr float overTolerance(int participants) {
  const auto p = static_cast<float>(participants);
  return 3.0f * p * (p - 1.0f) * 0x1p-24f;
}

}  // namespace burin::compositor::test
