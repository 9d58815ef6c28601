#pragma once

#include <algorithm>

namespace burin::node {

/// 0 below `from`, 1 above `to`, between them the quintic with vanishing first and second
/// derivatives at both ends (Perlin, "Improving noise", SIGGRAPH 2002).
inline double smoothRamp(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * t * (t * (t * 6 - 15) + 10);
}

}  // namespace burin::node
