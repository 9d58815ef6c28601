#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace burin::compositor {

/// What one view-parallel slice of a layer shows at one pixel. Nagy & Klein, "High-Quality
/// Silhouette Illustration for Texture-Based Volume Rendering", 2004.
enum class SliceSymbol : std::uint8_t {
  kEmpty,    ///< below the iso-value
  kFilled,   ///< above it, and so are all 8 neighbouring pixels on the same slice
  kContour,  ///< above it, but not all 8 neighbours are
};
inline constexpr std::size_t kSliceSymbols = 3;

/// What a ray knows of itself, slice by slice, front to back; it starts as kEmpty. kFilled and
/// kSilhouette are final.
enum class RayState : std::uint8_t { kEmpty, kFilled, kContour, kSilhouette };
inline constexpr std::size_t kRayStates = 4;
inline constexpr auto kStartOfRay = static_cast<std::size_t>(RayState::kEmpty);

constexpr bool isFinal(RayState state) {
  return state == RayState::kFilled || state == RayState::kSilhouette;
}

/// The state after one more slice: a contour that ends in empty space is a silhouette.
constexpr RayState next(RayState state, SliceSymbol symbol) {
  using enum RayState;
  using Row = std::array<RayState, kRayStates>;  // from kEmpty, kFilled, kContour, kSilhouette
  constexpr std::array<Row, kSliceSymbols> kTable{
      Row{kEmpty, kFilled, kSilhouette, kSilhouette},  // after an empty slice
      Row{kFilled, kFilled, kFilled, kSilhouette},     // after a filled one
      Row{kContour, kFilled, kContour, kSilhouette}};  // after a contour
  return kTable[static_cast<std::size_t>(symbol)][static_cast<std::size_t>(state)];
}

}  // namespace burin::compositor
