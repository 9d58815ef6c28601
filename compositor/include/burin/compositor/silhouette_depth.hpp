#pragma once

#include <cmath>

#include "burin/compositor/pixel_algebra.hpp"
#include "burin/compositor/silhouette_depth_functions.hpp"

namespace burin::compositor {

/// What a segment of slices does, and the depth of its last contour slice if the code needs one
/// (else 0). Depths are planar, in any one unit, and numbers.
struct SilhouetteDepthPixel {
  SilhouetteDepthCode code{};
  float depth = 0;
  friend bool operator==(const SilhouetteDepthPixel&, const SilhouetteDepthPixel&) = default;
};

/// Silhouette that also tells its depth, that of the last contour slice before it, for widths that
/// depend on depth. The depth travels only with the codes that have one.
struct SilhouetteDepth {
  using Pixel = SilhouetteDepthPixel;
  static constexpr std::size_t kFunctions = detail::kSilhouetteDepthClosure.elements.size();
  static constexpr std::size_t kMinWireBytes = 1;
  static constexpr std::size_t kMaxWireBytes = 1 + sizeof(float);
  static constexpr bool kWireIsMemory = false;

  static constexpr Pixel identity() { return {}; }
  static constexpr Pixel combine(const Pixel& front, const Pixel& back) {
    const auto& product = detail::kSilhouetteDepthProducts[index(front)][index(back)];
    const std::array depths{0.0f, front.depth, back.depth};  // in the order of Keeps
    return {product.code, depths[static_cast<std::size_t>(product.keeps)]};
  }
  static constexpr bool isIdentity(const Pixel& pixel) { return index(pixel) == 0; }

  static std::size_t store(const Pixel& pixel, std::span<std::byte> out) {
    out[0] = static_cast<std::byte>(pixel.code);
    if (!hasDepth(pixel)) return kMinWireBytes;
    std::memcpy(&out[1], &pixel.depth, sizeof(float));
    return kMaxWireBytes;
  }
  /// A depth that is no number is damage.
  static std::size_t load(std::span<const std::byte> in, Pixel& into) {
    if (in.empty() || std::to_integer<std::size_t>(in[0]) >= kFunctions) return 0;
    into = {static_cast<SilhouetteDepthCode>(in[0]), 0};
    if (!hasDepth(into)) return kMinWireBytes;
    if (in.size() < kMaxWireBytes) return 0;
    std::memcpy(&into.depth, &in[1], sizeof(float));
    return std::isnan(into.depth) ? 0 : kMaxWireBytes;
  }

  /// The segment of one slice at `depth`.
  static constexpr Pixel slice(SliceSymbol symbol, float depth) {
    return {static_cast<SilhouetteDepthCode>(1 + static_cast<unsigned>(symbol)),
            symbol == SliceSymbol::kContour ? depth : 0.0f};
  }
  static constexpr const SilhouetteDepthFunction& function(const Pixel& pixel) {
    return detail::kSilhouetteDepthClosure.elements[index(pixel)];
  }
  /// Of a whole ray, with the empty slice behind everything: kEmpty, kFilled, or kSilhouette, whose
  /// depth is then `ray.depth`.
  static constexpr RayState finalState(const Pixel& ray) {
    return next(function(ray)[kStartOfRay].state, SliceSymbol::kEmpty);
  }
  /// Nothing behind `segment` can change it, whatever lies in front of it.
  static constexpr bool canStop(const Pixel& segment) {
    return isFinal(function(segment)[kStartOfRay].state);
  }
  /// A contour of the segment's own matters to what comes after: then also to a ray that starts
  /// with the segment.
  static constexpr bool hasDepth(const Pixel& pixel) {
    return function(pixel)[kStartOfRay].depth == DepthOutcome::Depth::kInSegment;
  }

 private:
  static constexpr std::size_t index(const Pixel& pixel) {
    return static_cast<std::size_t>(pixel.code);
  }
};
static_assert(PixelAlgebra<SilhouetteDepth>);

}  // namespace burin::compositor
