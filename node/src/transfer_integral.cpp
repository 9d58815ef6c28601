#include "transfer_integral.hpp"

#include <algorithm>
#include <cmath>

namespace burin::node {
namespace {

/// Means over t in [0, 1] of -ln q and of -t ln q, q going linearly from q0 to q1, both above 0.
glm::dvec2 meansOfLogarithm(double q0, double q1) {
  const double d = q1 - q0;
  if (std::abs(d) <
      1e-2 * q0) {  // the antiderivatives' differences would cancel: Simpson, to 1e-10
    const double ends[2] = {-std::log(q0), -std::log(q1)};
    const double middle = -std::log(q0 + d / 2);
    return {(ends[0] + 4 * middle + ends[1]) / 6, (2 * middle + ends[1]) / 6};
  }
  const auto first = [](double q) { return q - q * std::log(q); };
  const auto second = [](double q) { return q * q * (0.25 - 0.5 * std::log(q)); };
  const double sum = first(q1) - first(q0);
  return {sum / d, (second(q1) - second(q0) - q0 * sum) / (d * d)};
}

/// Over values between which opacity and colour are linear.
glm::dvec4 overPiece(const TransferPoint& a, const TransferPoint& b, double from, double to) {
  const auto at = [&](double value) {
    const double t = b.value > a.value ? (value - a.value) / (b.value - a.value) : 0.0;
    const double opacity = a.opacity + t * (b.opacity - a.opacity);
    return glm::dvec4{(1 - t) * a.colour.linear() + t * b.colour.linear(),
                      1 - std::min(opacity, kLargestOpacity)};
  };
  const glm::dvec4 start = at(from);
  const glm::dvec4 end = at(to);
  const glm::dvec2 mean = meansOfLogarithm(start.a, end.a);
  const glm::dvec3 colour = (mean.x - mean.y) * glm::dvec3{start} + mean.y * glm::dvec3{end};
  return (to - from) * glm::dvec4{colour, mean.x};
}

}  // namespace

glm::dvec4 transferIntegral(const TransferFunction& function, double unitLength, double lowest,
                            double highest) {
  const auto& points = function.points;
  glm::dvec4 sum{0};
  const auto add = [&](const TransferPoint& a, const TransferPoint& b, double from, double to) {
    from = std::max(from, lowest);
    to = std::min(to, highest);
    if (from < to) sum += overPiece(a, b, from, to);
  };
  add(points.front(), points.front(), lowest, points.front().value);
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    add(points[i], points[i + 1], points[i].value, points[i + 1].value);
  add(points.back(), points.back(), points.back().value, highest);
  return sum / unitLength;
}

}  // namespace burin::node
