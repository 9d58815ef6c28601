#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "burin/host/histogram.hpp"

namespace burin::host {

namespace {

constexpr const char* kEighths[] = {" ", "▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};

/// Neighbouring bins joined, as many to each column.
std::vector<std::int64_t> joined(const std::vector<std::int64_t>& counts, int columns) {
  const std::size_t wanted = static_cast<std::size_t>(columns);
  const std::size_t perColumn = std::max<std::size_t>(1, (counts.size() + wanted - 1) / wanted);
  std::vector<std::int64_t> sums((counts.size() + perColumn - 1) / perColumn);
  for (std::size_t i = 0; i < counts.size(); ++i) sums[i / perColumn] += counts[i];
  return sums;
}

/// Height in eighths of a row: logarithmic, because air outnumbers all else by far. A value that
/// occurs at all shows at least one eighth.
int heightInEighths(std::int64_t count, std::int64_t largest, int rows) {
  if (count == 0) return 0;
  const double share =
      std::log1p(static_cast<double>(count)) / std::log1p(static_cast<double>(largest));
  return std::max(1, static_cast<int>(std::lround(share * rows * 8)));
}

}  // namespace

std::string drawHistogram(const Histogram& histogram, int columns, int rows) {
  const auto sums = joined(histogram.counts, columns);
  const std::int64_t largest = *std::max_element(sums.begin(), sums.end());
  std::string text;
  for (int row = rows - 1; row >= 0; --row) {
    text += "  ";
    for (const std::int64_t sum : sums) {
      const int height = heightInEighths(sum, largest, rows) - row * 8;
      text += kEighths[std::clamp(height, 0, 8)];
    }
    text += '\n';
  }
  const std::string low = fmt::format("{:.6g}", histogram.lowest);
  const std::string high = fmt::format("{:.6g}", histogram.highest);
  const int gap = static_cast<int>(sums.size()) - static_cast<int>(low.size());
  return text +
         fmt::format("  {}{:>{}}\n", low, high, std::max(gap, static_cast<int>(high.size()) + 1));
}

}  // namespace burin::host
