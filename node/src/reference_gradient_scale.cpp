#include "reference_gradient_scale.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace burin::node {

double ReferenceGradientScale::percentile(GradientOperator which) {
  std::optional<double>& known = percentiles_[which];
  if (!known) {
    std::vector<double> magnitudes = volume_.gradientMagnitudes(which);
    if (magnitudes.empty()) return known.emplace(0);
    const std::size_t rank = (magnitudes.size() * 999 + 999) / 1000;  // ⌈0.999 n⌉, counted from 1
    const auto chosen = magnitudes.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(magnitudes.begin(), chosen, magnitudes.end());
    known = *chosen;
  }
  return *known;
}

double ReferenceGradientScale::maximum(GradientOperator which) {
  std::optional<double>& known = maxima_[which];
  if (!known) {
    const std::vector<double> magnitudes = volume_.gradientMagnitudes(which);
    known = magnitudes.empty() ? 0 : *std::max_element(magnitudes.begin(), magnitudes.end());
  }
  return *known;
}

}  // namespace burin::node
