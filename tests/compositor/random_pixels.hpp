#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

#include "burin/compositor/flat_records.hpp"
#include "burin/compositor/largest_value.hpp"
#include "burin/compositor/maximum.hpp"
#include "burin/compositor/nearest.hpp"
#include "burin/compositor/over_half.hpp"
#include "burin/compositor/product.hpp"
#include "burin/compositor/silhouette.hpp"
#include "burin/compositor/silhouette_depth.hpp"
#include "burin/compositor/weighted_sum.hpp"

/// Random elements of every pixel algebra, and how equal two groupings of them must be.
namespace burin::compositor::test {

using Random = std::mt19937;

/// Uniform in [0, 1), the same on every platform.
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

inline Rgba randomPixel(const OverHalf&, Random& random) {
  return randomPixel(Over{}, random);
}

/// Few different values, so that many are equal, and some that are nothing.
inline float randomKey(float nothing, Random& random) {
  const int key = below(random, 8);
  if (key == 0) return nothing;
  return key == 1 ? -0.0f : static_cast<float>(key - 4);
}

inline MaximumPixel randomPixel(const Maximum&, Random& random) {
  const float value = randomKey(Maximum::identity().value, random);
  return Maximum::isIdentity({value, {}}) ? MaximumPixel{}
                                          : MaximumPixel{value, randomPixel(Over{}, random)};
}

inline LargestValuePixel randomPixel(const LargestValue&, Random& random) {
  return {randomKey(LargestValue::identity().value, random)};
}

/// Whole numbers, whose sums are exact.
inline WeightedSumPixel randomPixel(const WeightedSum&, Random& random) {
  return {static_cast<float>(below(random, 9) - 4), static_cast<float>(below(random, 5))};
}

inline NearestPixel randomPixel(const Nearest&, Random& random) {
  const float depth = randomKey(Nearest::identity().depth, random);
  return Nearest::isIdentity({depth, {}}) ? NearestPixel{}
                                          : NearestPixel{depth, randomPixel(Over{}, random)};
}

inline SliceSymbol randomSymbol(Random& random) {
  return static_cast<SliceSymbol>(below(random, int{kSliceSymbols}));
}

inline SilhouetteCode randomPixel(const Silhouette&, Random& random) {
  return static_cast<SilhouetteCode>(below(random, int{Silhouette::kFunctions}));
}

inline SilhouetteDepthPixel randomPixel(const SilhouetteDepth&, Random& random) {
  SilhouetteDepthPixel pixel{
      static_cast<SilhouetteDepthCode>(below(random, int{SilhouetteDepth::kFunctions})), 0};
  if (SilhouetteDepth::hasDepth(pixel)) pixel.depth = unit(random);
  return pixel;
}

template <std::size_t kPriorities>
FlatRecordsPixel<kPriorities> randomPixel(const FlatRecords<kPriorities>&, Random& random) {
  FlatRecordsPixel<kPriorities> pixel;
  for (std::size_t priority = 0; priority < kPriorities; ++priority) {
    if (below(random, 2) == 0) continue;
    pixel.used |= 1u << priority;
    pixel.records[priority] = {unit(random), randomPixel(Over{}, random)};
  }
  return pixel;
}

template <typename... Channels>
ProductPixel<Channels...> randomPixel(const Product<Channels...>&, Random& random) {
  return {{randomPixel(typename Channels::Algebra{}, random)}...};
}

/// Between two groupings of `over` over P pixels with channels in [0, 1]. One over rounds three
/// times: |error| <= 3u, u = 2^-24. Across P an opacity is off by <= 3(P-1)u; a colour inherits the
/// front's opacity error too, so <= 1.5 P(P-1)u to first order; two groupings: twice that.
constexpr float overTolerance(int pixels) {
  const auto p = static_cast<float>(pixels);
  return 3.0f * p * (p - 1.0f) * 0x1p-24f;
}

inline float largestDifference(const Rgba& p, const Rgba& q) {
  float largest = 0;
  for (const float d : {p.r - q.r, p.g - q.g, p.b - q.b, p.a - q.a}) {
    largest = std::isnan(d) ? d : std::fmax(largest, std::abs(d));
  }
  return largest;
}

/// Whether two groupings of `pixels` random pixels are as equal as the algebra promises.
template <PixelAlgebra A>
bool agree(const A&, const typename A::Pixel& p, const typename A::Pixel& q, int /*pixels*/) {
  return p == q;
}

inline bool agree(const Over&, const Rgba& p, const Rgba& q, int pixels) {
  return largestDifference(p, q) <= overTolerance(pixels);
}

inline bool agree(const OverHalf&, const Rgba& p, const Rgba& q, int pixels) {
  return agree(Over{}, p, q, pixels);
}

/// A group is at most all records of all pixels.
template <std::size_t kPriorities>
bool agree(const FlatRecords<kPriorities>&, const FlatRecordsPixel<kPriorities>& p,
           const FlatRecordsPixel<kPriorities>& q, int pixels) {
  bool allAgree = p.used == q.used;
  for (std::size_t i = 0; i < kPriorities; ++i) {
    allAgree = allAgree && p.records[i].scale == q.records[i].scale &&
               agree(Over{}, p.records[i].group, q.records[i].group, pixels * int{kPriorities});
  }
  return allAgree;
}

template <typename... Channels>
bool agree(const Product<Channels...>&, const ProductPixel<Channels...>& p,
           const ProductPixel<Channels...>& q, int pixels) {
  return (agree(typename Channels::Algebra{}, static_cast<const ChannelValue<Channels>&>(p).value,
                static_cast<const ChannelValue<Channels>&>(q).value, pixels) &&
          ...);
}

}  // namespace burin::compositor::test
