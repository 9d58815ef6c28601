#include "reference_widgets.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace burin::node {
namespace {

/// Gauss-Legendre nodes and weights on [-1, 1], three points (Abramowitz & Stegun, table 25.4): for
/// polynomials of degree five, and regions are of degree four at most between their kinks.
constexpr std::array<glm::dvec2, 3> kThreePoints{
    {{-0.774596669241483, 5.0 / 9}, {0, 8.0 / 9}, {0.774596669241483, 5.0 / 9}}};

/// Values where a region's extinction bends at that m.
void addKinks(const TransferWidget& widget, double magnitude, std::vector<double>& kinks) {
  const glm::dvec2 edges = widget.edgesAt(magnitude);
  kinks.insert(kinks.end(), {edges.x, edges.y});
  if (widget.shape == WidgetShape::kEllipse) return;
  const double fall = widget.valueFalloffUsed() * (edges.y - edges.x) / 2;
  kinks.insert(kinks.end(), {edges.x + fall, edges.y - fall});
}

}  // namespace

Classified ReferenceWidgets::between(double a, double b, double magnitude) const {
  const auto [from, to] = std::minmax(a, b);
  if (!(from < to)) return function_.classify(from, magnitude, unitLength_);
  std::vector<double> kinks{from, to};
  for (const TransferWidget& widget : function_.widgets) addKinks(widget, magnitude, kinks);
  std::ranges::sort(kinks);
  Classified sum{.colour = glm::dvec3{0}, .extinction = 0};
  for (std::size_t i = 0; i + 1 < kinks.size(); ++i) {
    const double begin = std::clamp(kinks[i], from, to);
    const double half = (std::clamp(kinks[i + 1], from, to) - begin) / 2;
    if (!(half > 0)) continue;
    for (const glm::dvec2& node : kThreePoints) {
      const Classified at = function_.classify(begin + half * (1 + node.x), magnitude, unitLength_);
      sum.extinction += node.y * half * at.extinction;
      sum.colour += node.y * half * at.extinction * at.colour;
    }
  }
  if (!(sum.extinction > 0)) return {glm::dvec3{0}, 0};
  return {sum.colour / sum.extinction, sum.extinction / (to - from)};
}

}  // namespace burin::node
