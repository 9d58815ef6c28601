#include "transfer_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "transfer_integral.hpp"

namespace burin::node {
namespace {

constexpr double kWantedError = 1e-6;
constexpr int kSmallestBins = 256;

/// Fewest bins (up to 4096) between the first and the last knot whose borders meet every knot; 0 if
/// there is no such number.
int commonGrid(std::span<const double> knots) {
  const double width = knots.back() - knots.front();
  for (int bins = 1; bins <= 4096; ++bins) {
    const bool meets = std::ranges::all_of(knots, [&](double knot) {
      const double position = (knot - knots.front()) / width * bins;
      return std::abs(position - std::round(position)) < 1e-7;
    });
    if (meets) return bins;
  }
  return 0;
}

/// The values that a table spans, and the bins it needs at least; 0 bins: knots without common
/// grid.
struct Domain {
  double first, last;
  int bins;
};

/// One bin beyond either end, so that a step at an end has its foot in the table.
Domain withoutGrid(double first, double last) {
  const double bin = (last - first) / (kLargestTransferTable - 3);
  return {first - bin, last + bin, 0};
}

/// What of the function's own span the data can reach, grown so that its borders lie on the common
/// grid of the knots in it. Points far outside the data must not take bins away from it.
Domain domainOf(const TransferFunction& function, double lowest, double highest) {
  const double first = std::clamp(function.points.front().value, lowest, highest);
  const double last = std::clamp(function.points.back().value, lowest, highest);
  const double smallestWidth = 1e-6 * (highest - lowest);
  if (!(last - first > smallestWidth))  // constant there, or one step
    return {first - 0.5 * smallestWidth, first + 0.5 * smallestWidth, 3};
  std::vector<double> knots;
  for (const TransferPoint& point : function.points)
    if (point.value >= first && point.value <= last &&
        (knots.empty() || point.value > knots.back()))
      knots.push_back(point.value);
  if (knots.empty()) return {first, last, 1};
  const bool single = knots.size() == 1;
  const int grid = single ? kSmallestBins : commonGrid(knots);
  if (grid == 0) return withoutGrid(first, last);
  const double bin = (single ? last - first : knots.back() - knots.front()) / grid;
  // A step at the first knot rises over the bin before it: what holds below the step must be in the
  // table.
  const auto& points = function.points;
  const bool startsWithStep = points.size() > 1 && points[0].value == points[1].value;
  const double before = startsWithStep ? 1 : 0;
  const double below = std::max(before, std::ceil((knots.front() - first) / bin - 1e-7));
  const double above = std::ceil((last - knots.back()) / bin - 1e-7);
  const double bins = (single ? 0 : grid) + below + above;
  if (bins >= kLargestTransferTable) return withoutGrid(first, last);
  return {knots.front() - below * bin, knots.back() + above * bin, static_cast<int>(bins)};
}

TransferTable sampled(const TransferFunction& function, double unitLength, double first,
                      double last, int bins) {
  TransferTable table{first, last, {}, {}};
  table.entries.reserve(static_cast<std::size_t>(bins) + 1);
  for (int i = 0; i <= bins; ++i) {
    const double value = i == bins ? last : first + (last - first) * i / bins;
    const Classified c = function.classify(value, unitLength);
    table.entries.emplace_back(glm::vec4{glm::vec3{c.colour}, static_cast<float>(c.extinction)});
  }
  return table;
}

/// Largest error of a unit length's opacity at the middle of the bins.
double middleError(const TransferTable& table, const TransferFunction& function,
                   double unitLength) {
  double worst = 0;
  for (std::size_t i = 0; i + 1 < table.entries.size(); ++i) {
    const double middle = table.first + (static_cast<double>(i) + 0.5) * table.binWidth();
    const double looked = 0.5 * (double{table.entries[i].a} + double{table.entries[i + 1].a});
    const double exact = function.classify(middle, unitLength).extinction;
    worst =
        std::max(worst, std::abs(std::exp(-looked * unitLength) - std::exp(-exact * unitLength)));
  }
  return worst;
}

std::vector<glm::dvec4> meansOfBins(const TransferTable& table, const TransferFunction& function,
                                    double unitLength) {
  std::vector<glm::dvec4> means;
  const double width = table.binWidth();
  for (std::size_t i = 0; i + 1 < table.entries.size(); ++i) {
    const double start = table.first + static_cast<double>(i) * width;
    means.push_back(transferIntegral(function, unitLength, start, start + width) / width);
  }
  return means;
}

/// A double as the sum of two floats.
std::pair<float, float> inTwo(double x) {
  const auto high = static_cast<float>(x);
  return {high, static_cast<float>(x - double{high})};
}

}  // namespace

glm::dvec2 TransferTable::visibleBins() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto shows = [&](std::size_t bin) {
    return entries[bin].a > 0 || entries[bin + 1].a > 0 || means[bin].a > 0;
  };
  const std::size_t bins = entries.size() - 1;
  std::size_t begin = 0;
  while (begin < bins && !shows(begin)) ++begin;
  if (begin == bins) return glm::dvec2{0};
  std::size_t end = bins;
  while (!shows(end - 1)) --end;
  return {entries.front().a > 0 ? -kInfinity : static_cast<double>(begin),
          entries.back().a > 0 ? kInfinity : static_cast<double>(end)};
}

TransferRows transferRows(const TransferTable& table) {
  const auto& entries = table.entries;
  TransferRows rows{entries, {}, {}};
  rows.table.push_back(entries.back());
  glm::dvec4 sum{0};
  const auto addBin = [&](double integral, double start, double rise) {
    const auto [high, low] = inTwo(integral);
    rows.extinction.emplace_back(glm::vec4{glm::dvec4{high, low, start, rise}});
  };
  addBin(-double{entries.front().a}, entries.front().a, 0);
  for (std::size_t i = 0; i < table.means.size(); ++i) {
    rows.colour.emplace_back(glm::vec4{sum});
    // The line between the entries, scaled to the bin's mean; flat where it misses all there is.
    const glm::dvec4& mean = table.means[i];
    const double from = entries[i].a;
    const double to = entries[i + 1].a;
    const double line = (from + to) / 2;
    const double scale = line > 0 ? mean.a / line : 0.0;
    addBin(sum.a, line > 0 ? scale * from : mean.a, scale * (to - from));
    sum += mean;
  }
  addBin(sum.a, entries.back().a, 0);
  rows.colour.resize(entries.size() + 1, glm::vec4{sum});
  return rows;
}

TransferTable makeTransferTable(const TransferFunction& function, double unitLength, double lowest,
                                double highest) {
  const auto [first, last, grid] = domainOf(function, lowest, highest);
  int bins = grid == 0 ? kLargestTransferTable - 1 : grid * ((kSmallestBins + grid - 1) / grid);
  TransferTable table = sampled(function, unitLength, first, last, bins);
  while (middleError(table, function, unitLength) > kWantedError &&
         2 * bins + 1 <= kLargestTransferTable) {
    bins *= 2;
    table = sampled(function, unitLength, first, last, bins);
  }
  table.means = meansOfBins(table, function, unitLength);
  return table;
}

}  // namespace burin::node
