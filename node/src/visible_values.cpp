#include "visible_values.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burin::node {
namespace {

/// Of a stored value, relative: filtering equal texels, and where the table begins in a float.
constexpr double kRounding = 1e-6;

/// Voxels, more than a sample's place rounds by. Where not its own value counts, but those of
/// voxels around it or of a halo's neighbours, one beyond a cube's face by that much may see what
/// is on the other side.
constexpr double kPlaceRounding = 1e-3;

/// The next float downwards, or upwards, so that rounding never narrows an interval.
float below(double x) {
  if (x == 0) return 0;
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
float above(double x) {
  if (x == 0) return 0;
  return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity());
}

}  // namespace

std::vector<TransferTable> transferTables(const Scene& scene, const ValueScale& scale) {
  std::vector<TransferTable> tables;
  for (const TransferFunction& function : transferFunctions(scene))
    tables.push_back(makeTransferTable(function, function.opacityUnitLength.value(), scale.lowest,
                                       scale.highest));
  return tables;
}

VisibleValues::VisibleValues(const Scene& scene, std::span<const TransferTable> tables,
                             const ValueScale& scale) {
  const double halos = haloReach(scene);
  if (scene.quality.palettes == Palettes::kBefore || halos > 0) reach_ = halos + kPlaceRounding;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<TransferFunction> functions = transferFunctions(scene);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const auto& points = functions[i].points;
    const TransferTable& table = tables[i];
    const double bin = table.binWidth();
    // Before its first and after its last visible bin the program says exactly 0, so that volumes
    // full of the very value where a function begins are not all visible; there only the rounding
    // of that value counts. Between, a look-up may round into the next bin.
    const glm::dvec2 bins = table.visibleBins();
    if (bins.x == bins.y) continue;
    double first = scale.stored(table.first + bins.x * bin);
    double last = scale.stored(table.first + bins.y * bin);
    first -= std::isfinite(first) ? kRounding * std::abs(first) : 0;
    last += std::isfinite(last) ? kRounding * std::abs(last) : 0;
    const auto show = [&](double lowest, double highest) {
      lowest = std::max(scale.stored(lowest - bin), first);
      highest = std::min(scale.stored(highest + bin), last);
      if (lowest < highest) intervals_.push_back({below(lowest), above(highest)});
    };
    // Opacity is linear between points, so it is above 0 between two of which one's is.
    if (points.front().opacity > 0) show(-kInfinity, points.front().value);
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      if (points[k].opacity > 0 || points[k + 1].opacity > 0)
        show(points[k].value, points[k + 1].value);
    if (points.back().opacity > 0) show(points.back().value, kInfinity);
  }
  for (const double from : projectedFrom(scene)) {
    const double value = scale.stored(from);
    intervals_.push_back({std::isfinite(value)
                              ? below(value - kRounding * std::max(std::abs(value), 1.0))
                              : -std::numeric_limits<float>::infinity(),
                          std::numeric_limits<float>::infinity()});
  }
  for (const double surface : shownSurfaces(scene)) {
    const double value = scale.stored(surface);
    const double rounding = kRounding * std::max(std::abs(value), 1.0);
    intervals_.push_back({below(value - rounding), above(value + rounding)});
  }
  std::ranges::sort(intervals_, {}, &Interval::lowest);
  std::vector<Interval> merged;
  for (const Interval& interval : intervals_) {
    if (!merged.empty() && interval.lowest <= merged.back().highest)
      merged.back().highest = std::max(merged.back().highest, interval.highest);
    else
      merged.push_back(interval);
  }
  intervals_ = std::move(merged);
}

int VisibleValues::reach(int cubeCells) const {
  return static_cast<int>(std::ceil(reach_ / cubeCells));
}

}  // namespace burin::node
