#pragma once

#include <algorithm>

namespace burin::node {

/// Hermite step from 0 at `from` to 1 at `to`.
inline double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

template <typename T>
T blend(const T& a, const T& b, double amount) {
  return a + (b - a) * amount;
}

}  // namespace burin::node
