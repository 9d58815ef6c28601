#include "burin/common/transfer_function.hpp"

#include <algorithm>
#include <cmath>

#include "burin/common/error.hpp"

namespace burin {

double extinctionFromOpacity(double opacity, double unitLength) {
  // log1p: exact for tiny opacities, where 1 - opacity would round.
  return -std::log1p(-std::min(opacity, kLargestOpacity)) / unitLength;
}

Classified TransferFunction::classify(double value, double unitLength) const {
  BURIN_CHECK(!points.empty());
  // The first point beyond the value: of two points at one value the later one holds there.
  const auto above = std::upper_bound(points.begin(), points.end(), value,
                                      [](double v, const TransferPoint& p) { return v < p.value; });
  if (above == points.begin() || above == points.end()) {
    const TransferPoint& end = above == points.end() ? points.back() : points.front();
    return {end.colour.linear(), extinctionFromOpacity(end.opacity, unitLength)};
  }
  const TransferPoint& a = *(above - 1);
  const TransferPoint& b = *above;
  // Halved first, so that points at opposite ends of the double range do not overflow.
  const double t = (value / 2 - a.value / 2) / (b.value / 2 - a.value / 2);
  const double opacity = (1 - t) * a.opacity + t * b.opacity;
  return {(1 - t) * a.colour.linear() + t * b.colour.linear(),
          extinctionFromOpacity(opacity, unitLength)};
}

double TransferFunction::largestExtinction(double lo, double hi, double unitLength) const {
  if (!(lo <= hi)) return 0;  // no value at all: a cell of NaN voxels
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
