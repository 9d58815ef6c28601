#include "burin/common/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "burin/common/error.hpp"

namespace burin {

namespace {

/// The two nodes around `within`, and where x lies between them; at an end or beyond it one node
/// twice.
template <typename N>
struct Interval {
  const N& lower;
  const N& upper;
  double t;
};

template <typename N>
Interval<N> intervalAt(const std::vector<N>& nodes, double x, double within) {
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), within,
                                      [](double value, const N& node) { return value < node.x; });
  if (above == nodes.begin()) return {nodes.front(), nodes.front(), 0};
  if (above == nodes.end()) return {nodes.back(), nodes.back(), 0};
  const N& lower = *(above - 1);
  const double t = (x - lower.x) / (above->x - lower.x);
  return {lower, *above, std::clamp(t, 0.0, 1.0)};
}

bool isSharp(double sharpness) {
  return sharpness > 0.99;
}

/// Which side of a sharp interval's middle `within` lies on decides, where x is the middle itself.
template <typename N>
double weightAt(const Interval<N>& interval, double within) {
  double t = interval.t;
  if (isSharp(interval.lower.sharpness) && interval.upper.x > interval.lower.x)
    t = (within - interval.lower.x) / (interval.upper.x - interval.lower.x);
  return nodeWeight(t, interval.lower.midpoint, interval.lower.sharpness);
}

// The map at x, or its limit there from the side on which `within` lies: no node is between them.

glm::dvec3 colourBeside(const ColourMap& map, double x, double within) {
  const auto found = intervalAt(map.colours, x, within);
  return blendColours(map.space, map.hueWraps, found.lower.colour, found.upper.colour,
                      weightAt(found, within));
}

double opacityBeside(const ColourMap& map, double x, double within) {
  if (map.opacities.empty()) {
    const double first = map.colours.front().x;
    const double last = map.colours.back().x;
    return last > first ? std::clamp((x - first) / (last - first), 0.0, 1.0) : 1;
  }
  const auto found = intervalAt(map.opacities, x, within);
  const double weight = weightAt(found, within);
  return (1 - weight) * found.lower.opacity + weight * found.upper.opacity;
}

/// Where the map may have kinks or steps.
std::vector<double> breaksOf(const ColourMap& map) {
  std::vector<double> breaks;
  const auto add = [&](const auto& nodes, bool haveKinks) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      breaks.push_back(nodes[i].x);
      const bool isPlain = nodes[i].midpoint == 0.5 && nodes[i].sharpness == 0 && !haveKinks;
      if (isPlain || i + 1 == nodes.size()) continue;
      breaks.push_back(nodes[i].x + nodes[i].midpoint * (nodes[i + 1].x - nodes[i].x));
    }
  };
  add(map.colours, map.space == ColourSpace::kDiverging);  // at the white in the middle
  add(map.opacities, false);
  std::ranges::sort(breaks);
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

Colour rounded(const glm::dvec3& srgb) {
  const auto code = [](double value) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
  };
  return {code(srgb.r), code(srgb.g), code(srgb.b)};
}

/// Makes points of the pieces between the breaks.
class Resampler {
 public:
  explicit Resampler(const ColourMap& map) : map_{map} {}

  std::vector<TransferPoint> run() {
    const std::vector<double> breaks = breaksOf(map_);
    if (breaks.size() == 1) add(pointAt(breaks[0], breaks[0]));
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      within_ = (breaks[i] + breaks[i + 1]) / 2;
      const TransferPoint from = pointAt(breaks[i], within_);
      const TransferPoint to = pointAt(breaks[i + 1], within_);
      add(from);
      addBetween(from, to, 0);
      add(to);
    }
    return std::move(points_);
  }

 private:
  TransferPoint pointAt(double x, double within) const {
    return {x, rounded(colourBeside(map_, x, within)), opacityBeside(map_, x, within)};
  }

  /// Two points at one value are a step; the third would be one of them again.
  void add(const TransferPoint& point) {
    if (points_.empty() || points_.back() != point) points_.push_back(point);
  }

  void addBetween(const TransferPoint& from, const TransferPoint& to, int depth) {
    constexpr int kDeepest = 9;
    const double middle = (from.value + to.value) / 2;
    const bool isDivisible = from.value < middle && middle < to.value && depth < kDeepest;
    if (!isDivisible || isLinear(from, to)) return;
    const TransferPoint between = pointAt(middle, middle);
    addBetween(from, between, depth + 1);
    add(between);
    addBetween(between, to, depth + 1);
  }

  /// Whether the line between two points is as near to the map as it has to be.
  bool isLinear(const TransferPoint& from, const TransferPoint& to) const {
    constexpr int kProbes = 8;
    const TransferFunction line{{from, to}, 1.0};
    for (int i = 1; i < kProbes; ++i) {
      const double x = from.value + (to.value - from.value) * i / kProbes;
      const glm::dvec3 linear = line.classify(x, 1).colour;
      const glm::dvec3 shown{srgbFromLinear(linear.r), srgbFromLinear(linear.g),
                             srgbFromLinear(linear.b)};
      const glm::dvec3 codes = 255.0 * glm::abs(shown - colourBeside(map_, x, x));
      const double opacity = from.opacity + (to.opacity - from.opacity) * i / kProbes;
      // A little less than promised, as other values lie between the probes.
      if (std::max({codes.r, codes.g, codes.b}) > 0.8 * kColourMapCodes ||
          std::abs(opacity - opacityBeside(map_, x, x)) > 0.8 * kColourMapOpacity)
        return false;
    }
    return true;
  }

  const ColourMap& map_;
  double within_ = 0;
  std::vector<TransferPoint> points_;
};

}  // namespace

glm::dvec3 ColourMap::colourAt(double x) const {
  return colourBeside(*this, x, x);
}

double ColourMap::opacityAt(double x) const {
  return opacityBeside(*this, x, x);
}

TransferFunction transferFunctionFrom(const ColourMap& map,
                                      const std::optional<glm::dvec2>& range) {
  BURIN_CHECK(!map.colours.empty());
  TransferFunction function{Resampler{map}.run(), map.unitLength};
  if (range) {
    const double first = map.colours.front().x;
    const double span = map.colours.back().x - first;
    for (TransferPoint& point : function.points) {
      const double t = span > 0 ? (point.value - first) / span : 0;
      point.value = (1 - t) * range->x + t * range->y;
    }
  }
  return function;
}

}  // namespace burin
