#include "reference_mean_class.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace burin::node {
namespace {

/// Gauss-Legendre nodes and weights on [-1, 1], eight points (Abramowitz & Stegun, table 25.4).
constexpr std::array<glm::dvec2, 4> kGauss{{{0.183434642495650, 0.362683783378362},
                                            {0.525532409916329, 0.313706645877887},
                                            {0.796666477413627, 0.222381034453374},
                                            {0.960289856497536, 0.101228536290376}}};

/// Opacities at which a rising or falling piece is cut: -ln(1 - opacity) bends ever more towards 1,
/// and eight points follow it over a factor of ten in 1 - opacity to 1e-9.
constexpr std::array kBends{0.9, 0.99, 0.999, kLargestOpacity};

struct Integral {
  double extinction = 0;
  glm::dvec3 colour{0};  ///< times extinction
};

/// Over a piece without knots inside. Open rule: the ends, where a step may stand, are not asked.
void addPiece(Integral& sum, const TransferFunction& function, double unitLength, double from,
              double to) {
  const double middle = from + (to - from) / 2;
  const double half = (to - from) / 2;
  for (const glm::dvec2& node : kGauss)
    for (const double side : {-1.0, 1.0}) {
      const Classified c = function.classify(middle + side * node.x * half, unitLength);
      sum.extinction += node.y * half * c.extinction;
      sum.colour += node.y * half * c.extinction * c.colour;
    }
}

}  // namespace

ReferenceMeanClass::ReferenceMeanClass(const TransferFunction& function, double unitLength)
    : function_{function}, unitLength_{unitLength} {
  const auto& points = function.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    cuts_.push_back(points[i].value);
    if (i + 1 == points.size()) break;
    const double rise = points[i + 1].opacity - points[i].opacity;
    for (const double bend : kBends) {
      const double part = (bend - points[i].opacity) / rise;
      if (part > 0 && part < 1)
        cuts_.push_back(points[i].value + part * (points[i + 1].value - points[i].value));
    }
  }
  std::ranges::sort(cuts_);
}

Classified ReferenceMeanClass::between(double a, double b) const {
  const auto [from, to] = std::minmax(a, b);
  if (!(from < to)) return function_.classify(from, unitLength_);
  Integral sum;
  double begin = from;
  for (auto cut = std::ranges::upper_bound(cuts_, from); cut != cuts_.end() && *cut < to; ++cut) {
    if (begin < *cut) addPiece(sum, function_, unitLength_, begin, *cut);
    begin = *cut;
  }
  addPiece(sum, function_, unitLength_, begin, to);
  if (!(sum.extinction > 0)) return {glm::dvec3{0}, 0};
  return {sum.colour / sum.extinction, sum.extinction / (to - from)};
}

}  // namespace burin::node
