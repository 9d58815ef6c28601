#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "burin/common/colour.hpp"
#include "burin/common/transfer_widget.hpp"

namespace burin {

struct TransferPoint {
  double value = 0;  ///< data units
  Colour colour;
  double opacity = 0;  ///< in [0, 1], per opacity unit length
  friend bool operator==(const TransferPoint&, const TransferPoint&) = default;
};

/// What a transfer function says about one value, as it was written.
struct ColourAndOpacity {
  glm::dvec3 colour;   ///< linear RGB, not premultiplied
  double opacity = 0;  ///< in [0, 1], per opacity unit length
};

/// What a transfer function says about one value of a medium.
struct Classified {
  glm::dvec3 colour;      ///< linear RGB, not premultiplied
  double extinction = 0;  ///< per world unit
};

/// Opacities above this are cut, so that the extinction stays finite (scene contract).
inline constexpr double kLargestOpacity = 0.9999;

/// Piecewise linear between points, in linear RGB and in opacity; the end values hold outside.
/// Points are sorted by value; two points at one value make a step (the later holds at the value).
/// Or two-dimensional: widgets over value and gradient magnitude, and no points.
struct TransferFunction {
  std::vector<TransferPoint> points;
  std::optional<double> opacityUnitLength;  ///< world units; unset: the smallest spacing
  std::vector<TransferWidget> widgets = {};

  bool isTwoDimensional() const { return !widgets.empty(); }
  /// Exact evaluation in double, of points.
  ColourAndOpacity lookUp(double value) const;
  /// The same with extinctions. `unitLength`: opacityUnitLength, resolved.
  Classified classify(double value, double unitLength) const;
  /// The same of widgets; `magnitude`: m in [0, 1]. Colours are mixed by extinction, black where
  /// there is none.
  Classified classify(double value, double magnitude, double unitLength) const;
  /// Of widgets, a function of points that is above 0 between values where any of them shows at
  /// some m, and 0 elsewhere: what can be told of a value alone.
  TransferFunction envelope() const;
  /// Largest extinction over the closed interval [lo, hi] of values, exact of points; of widgets
  /// above 0 only where they may show something.
  double largestExtinction(double lo, double hi, double unitLength) const;
  friend bool operator==(const TransferFunction&, const TransferFunction&) = default;
};

/// σ = -ln(1 - min(opacity, kLargestOpacity)) / unitLength.
double extinctionFromOpacity(double opacity, double unitLength);

}  // namespace burin
