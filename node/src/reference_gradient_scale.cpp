#include "reference_gradient_scale.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace burin::node {

double ReferenceGradientScale::percentile() {
  if (!percentile_) {
    std::vector<double> magnitudes = volume_.gradientMagnitudes();
    if (magnitudes.empty()) return percentile_.emplace(0);
    const std::size_t rank = (magnitudes.size() * 999 + 999) / 1000;  // ⌈0.999 n⌉, counted from 1
    const auto chosen = magnitudes.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(magnitudes.begin(), chosen, magnitudes.end());
    percentile_ = *chosen;
  }
  return *percentile_;
}

double ReferenceGradientScale::maximum() {
  if (!maximum_) {
    const std::vector<double> magnitudes = volume_.gradientMagnitudes();
    maximum_ = magnitudes.empty() ? 0 : *std::max_element(magnitudes.begin(), magnitudes.end());
  }
  return *maximum_;
}

}  // namespace burin::node
