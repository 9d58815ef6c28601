#pragma once

#include "burin/compositor/closure.hpp"
#include "burin/compositor/silhouette_automaton.hpp"

namespace burin::compositor {

/// Which of the 8 functions a segment of slices with depths is, numbered like SilhouetteCode.
enum class SilhouetteDepthCode : std::uint8_t {};

/// Where a segment leaves a ray, and whose depth the state then has: that of the last contour
/// slice, which lies in front of the segment or in it.
struct DepthOutcome {
  enum class Depth : std::uint8_t { kNone, kInFront, kInSegment };
  RayState state{};
  Depth depth{};
  friend constexpr bool operator==(const DepthOutcome&, const DepthOutcome&) = default;
};

/// What a segment of slices does: the outcome, by the state before it.
using SilhouetteDepthFunction = std::array<DepthOutcome, kRayStates>;

namespace detail {

using Depth = DepthOutcome::Depth;

/// A contour takes its slice's depth, a silhouette keeps the depth it has, the others have none.
constexpr DepthOutcome afterSlice(RayState before, SliceSymbol symbol) {
  const RayState after = next(before, symbol);
  if (after == RayState::kContour) return {after, Depth::kInSegment};
  return {after, after == RayState::kSilhouette ? Depth::kInFront : Depth::kNone};
}

constexpr SilhouetteDepthFunction composeDepth(const SilhouetteDepthFunction& front,
                                               const SilhouetteDepthFunction& back) {
  SilhouetteDepthFunction both{};
  for (std::size_t before = 0; before < kRayStates; ++before) {
    both[before] = back[static_cast<std::size_t>(front[before].state)];
    if (both[before].depth == Depth::kInFront) both[before].depth = front[before].depth;
  }
  return both;
}

/// One function more than without depth: a silhouette made of a contour in front of the segment has
/// that contour's depth, one made of the segment's own has its own.
inline constexpr auto kSilhouetteDepthClosure = [] {
  SilhouetteDepthFunction identity{};
  std::array<SilhouetteDepthFunction, kSliceSymbols> slices{};
  for (std::size_t before = 0; before < kRayStates; ++before) {
    const auto state = static_cast<RayState>(before);
    const bool hasDepth = state == RayState::kContour || state == RayState::kSilhouette;
    identity[before] = {state, hasDepth ? Depth::kInFront : Depth::kNone};
    for (std::size_t symbol = 0; symbol < kSliceSymbols; ++symbol) {
      slices[symbol][before] = afterSlice(state, static_cast<SliceSymbol>(symbol));
    }
  }
  return closureOf<8>(identity, slices, composeDepth);
}();

/// Two segments together: the code, and which of the two depths it keeps.
struct DepthProduct {
  enum class Keeps : std::uint8_t { kNeither, kFront, kBack };
  SilhouetteDepthCode code{};
  Keeps keeps{};
};

/// Does not compile if a product needed both depths.
constexpr DepthProduct::Keeps keptDepth(const SilhouetteDepthFunction& front,
                                        const SilhouetteDepthFunction& back) {
  bool needsFront = false;
  bool needsBack = false;
  for (const DepthOutcome& between : front) {
    const DepthOutcome& after = back[static_cast<std::size_t>(between.state)];
    needsBack |= after.depth == Depth::kInSegment;
    needsFront |= after.depth == Depth::kInFront && between.depth == Depth::kInSegment;
  }
  if (needsFront && needsBack) throw "one depth is not enough";
  if (needsFront) return DepthProduct::Keeps::kFront;
  return needsBack ? DepthProduct::Keeps::kBack : DepthProduct::Keeps::kNeither;
}

inline constexpr auto kSilhouetteDepthProducts = [] {
  constexpr std::size_t kSize = kSilhouetteDepthClosure.elements.size();
  std::array<std::array<DepthProduct, kSize>, kSize> products{};
  for (std::size_t front = 0; front < kSize; ++front) {
    for (std::size_t back = 0; back < kSize; ++back) {
      const auto& elements = kSilhouetteDepthClosure.elements;
      products[front][back] = {SilhouetteDepthCode{kSilhouetteDepthClosure.product[front][back]},
                               keptDepth(elements[front], elements[back])};
    }
  }
  return products;
}();

}  // namespace detail
}  // namespace burin::compositor
