#pragma once

#include <algorithm>
#include <vector>

namespace burin::host::bench {

/// The middle one of `values` (not empty), or the mean of the two in the middle.
inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace burin::host::bench
