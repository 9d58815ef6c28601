#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "burin/common/colour.hpp"

namespace burin {

struct TransferPoint {
  double value = 0;  ///< data units
  Colour colour;
  double opacity = 0;  ///< in [0, 1], per opacity unit length
  friend bool operator==(const TransferPoint&, const TransferPoint&) = default;
};

/// What a transfer function says about one value.
struct Classified {
  glm::dvec3 colour;      ///< linear RGB, not premultiplied
  double extinction = 0;  ///< per world unit
};

/// Opacities above this are cut, so that the extinction stays finite (scene contract).
inline constexpr double kLargestOpacity = 0.9999;

/// Piecewise linear between points, in linear RGB and in opacity; the end values hold outside.
/// Points are sorted by value; two points at one value make a step (the later holds at the value).
struct TransferFunction {
  std::vector<TransferPoint> points;
  std::optional<double> opacityUnitLength;  ///< world units; unset: the smallest spacing

  /// Exact evaluation in double. `unitLength`: opacityUnitLength, resolved.
  Classified classify(double value, double unitLength) const;
  /// Largest extinction over the closed interval [lo, hi] of values, exact.
  double largestExtinction(double lo, double hi, double unitLength) const;
  friend bool operator==(const TransferFunction&, const TransferFunction&) = default;
};

/// σ = -ln(1 - min(opacity, kLargestOpacity)) / unitLength.
double extinctionFromOpacity(double opacity, double unitLength);

}  // namespace burin
