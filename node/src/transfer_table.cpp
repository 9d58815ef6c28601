#include "transfer_table.hpp"

#include <algorithm>
#include <cmath>
#include <span>

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
  if (grid == 0) return {first, last, 0};
  const double bin = (single ? last - first : knots.back() - knots.front()) / grid;
  const double below = std::ceil((knots.front() - first) / bin - 1e-7);
  const double above = std::ceil((last - knots.back()) / bin - 1e-7);
  const double bins = (single ? 0 : grid) + below + above;
  if (bins >= kLargestTransferTable) return {first, last, 0};
  return {knots.front() - below * bin, knots.back() + above * bin, static_cast<int>(bins)};
}

TransferTable sampled(const TransferFunction& function, double unitLength, double first,
                      double last, int bins) {
  TransferTable table{first, last, {}};
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

}  // namespace

TransferTable makeTransferTable(const TransferFunction& function, double unitLength, double lowest,
                                double highest) {
  const auto [first, last, grid] = domainOf(function, lowest, highest);
  if (grid == 0) return sampled(function, unitLength, first, last, kLargestTransferTable - 1);
  int bins = grid * ((kSmallestBins + grid - 1) / grid);
  TransferTable table = sampled(function, unitLength, first, last, bins);
  while (middleError(table, function, unitLength) > kWantedError &&
         2 * bins + 1 <= kLargestTransferTable) {
    bins *= 2;
    table = sampled(function, unitLength, first, last, bins);
  }
  return table;
}

}  // namespace burin::node
