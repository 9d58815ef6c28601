#include "burin/common/transfer_function.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "burin/common/error.hpp"

namespace burin {

double extinctionFromOpacity(double opacity, double unitLength) {
  // log1p: exact for tiny opacities, where 1 - opacity would round.
  return -std::log1p(-std::min(opacity, kLargestOpacity)) / unitLength;
}

ColourAndOpacity TransferFunction::lookUp(double value) const {
  BURIN_CHECK(!points.empty());
  // The first point beyond the value: of two points at one value the later one holds there.
  const auto above = std::upper_bound(points.begin(), points.end(), value,
                                      [](double v, const TransferPoint& p) { return v < p.value; });
  if (above == points.begin() || above == points.end()) {
    const TransferPoint& end = above == points.end() ? points.back() : points.front();
    return {end.colour.linear(), end.opacity};
  }
  const TransferPoint& a = *(above - 1);
  const TransferPoint& b = *above;
  // Halved first, so that points at opposite ends of the double range do not overflow.
  const double t = (value / 2 - a.value / 2) / (b.value / 2 - a.value / 2);
  return {(1 - t) * a.colour.linear() + t * b.colour.linear(), (1 - t) * a.opacity + t * b.opacity};
}

Classified TransferFunction::classify(double value, double unitLength) const {
  const ColourAndOpacity at = lookUp(value);
  return {at.colour, extinctionFromOpacity(at.opacity, unitLength)};
}

Classified TransferFunction::classify(double value, double magnitude, double unitLength) const {
  Classified sum{.colour = glm::dvec3{0}, .extinction = 0};
  for (const TransferWidget& widget : widgets) {
    const double extinction =
        extinctionFromOpacity(widget.opacity, unitLength) * widget.weight(value, magnitude);
    sum.colour += extinction * widget.colour.linear();
    sum.extinction += extinction;
  }
  if (sum.extinction > 0) sum.colour /= sum.extinction;
  return sum;
}

TransferFunction TransferFunction::envelope() const {
  std::vector<glm::dvec2> ranges;
  double largest = 0;
  for (const TransferWidget& widget : widgets) {
    if (!(widget.opacity > 0)) continue;
    ranges.push_back(widget.valueRange());
    largest = std::max(largest, widget.opacity);
  }
  std::ranges::sort(ranges, {}, [](const glm::dvec2& range) { return range.x; });
  TransferFunction function{{}, opacityUnitLength};
  double end = -std::numeric_limits<double>::infinity();
  for (const glm::dvec2& range : ranges) {
    if (range.x > end) {
      if (!function.points.empty()) function.points.push_back({end, {}, 0});
      function.points.push_back({range.x, {}, 0});
      function.points.push_back({range.x, {}, largest});
      function.points.push_back({range.y, {}, largest});
    }
    end = std::max(end, range.y);
    function.points.back().value = end;
  }
  if (ranges.empty()) end = widgets.front().value.x;
  function.points.push_back({end, {}, 0});
  return function;
}

double TransferFunction::largestExtinction(double lo, double hi, double unitLength) const {
  if (!(lo <= hi)) return 0;  // no value at all: a cell of NaN voxels
  if (isTwoDimensional()) return envelope().largestExtinction(lo, hi, unitLength);
  double largest =
      std::max(classify(lo, unitLength).extinction, classify(hi, unitLength).extinction);
  // Piecewise linear opacity is largest at an end or at a point; at a step inside the interval both
  // its points count, since the field comes arbitrarily close to the earlier one. At lo itself only
  // the later one does, and classify(lo) has seen it.
  for (const TransferPoint& point : points) {
    if (point.value > lo && point.value <= hi) {
      largest = std::max(largest, extinctionFromOpacity(point.opacity, unitLength));
    }
  }
  return largest;
}

}  // namespace burin
