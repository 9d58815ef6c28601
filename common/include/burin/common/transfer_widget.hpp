#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "burin/common/colour.hpp"

namespace burin {

enum class WidgetShape {
  kTriangle,  ///< from its apex on the value axis (m = 0) to `value` at the upper end of `gradient`
  kRectangle,  ///< `value` by `gradient`
  kEllipse,    ///< inscribed in `value` by `gradient`
};

/// A region of a two-dimensional transfer function, over value (data units) and gradient magnitude
/// m (0 … 1, over the volume's scale): Kniss, Kindlmann & Hansen, "Interactive Volume Rendering
/// Using Multi-Dimensional Transfer Functions and Direct Manipulation Widgets", IEEE Visualization
/// 2001. Regions are simultaneous media. Their extinction falls off linearly towards the edges of
/// triangles and rectangles, as (1 - r²)² in ellipses; extinction rather than opacity, so that its
/// mean over values has a closed form without logarithms.
struct TransferWidget {
  WidgetShape shape = WidgetShape::kRectangle;
  glm::dvec2 value{0, 1};      ///< data units, rising
  glm::dvec2 gradient{0, 1};   ///< m, rising
  std::optional<double> apex;  ///< of a triangle; unset: the middle of `value`
  /// Shares of half the width (in value) and of half the height (in m) over which the extinction
  /// falls to 0. Not of ellipses.
  std::optional<double> valueFalloff, gradientFalloff;
  Colour colour;
  double opacity = 0;  ///< in [0, 1], where it is largest, per opacity unit length

  /// valueFalloff, or its default: 1 of triangles, else 0.25.
  double valueFalloffUsed() const;
  /// gradientFalloff, or its default.
  double gradientFalloffUsed() const { return gradientFalloff.value_or(0.25); }
  /// All values that it shows at any m lie between these.
  glm::dvec2 valueRange() const;
  /// Values between which it shows at m; the first at or above the second: none.
  glm::dvec2 edgesAt(double magnitude) const;
  /// Part of its largest extinction at a value and m in [0, 1]. A rectangle's edge at m = 0, and
  /// one of a triangle or rectangle at m = 1, is none: it goes on with no falloff.
  double weight(double dataValue, double magnitude) const;
  friend bool operator==(const TransferWidget&, const TransferWidget&) = default;

 private:
  double weightOfMagnitude(double magnitude) const;
};

/// Smallest falloff: an edge that any narrower would look like a step to the look-ups' rounding.
inline constexpr double kSmallestFalloff = 0.01;

}  // namespace burin
