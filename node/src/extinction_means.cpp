#include "extinction_means.hpp"

#include <algorithm>

#include "transfer_integral.hpp"

namespace burin::node {
namespace {

constexpr int kExtinctionBins = 1024;

}  // namespace

ExtinctionMeans::ExtinctionMeans(const Scene& scene, const ValueScale& scale)
    : first_{scale.stored(scale.lowest)}, sums_(kExtinctionBins + 1) {
  const double width = (scale.highest - scale.lowest) / kExtinctionBins;
  binsPerValue_ = kExtinctionBins / (scale.stored(scale.highest) - first_);
  for (const TransferFunction& function : transferFunctions(scene)) {
    double sum = 0;
    for (int bin = 0; bin < kExtinctionBins; ++bin) {
      const double from = scale.lowest + bin * width;
      sum += transferIntegral(function, function.opacityUnitLength.value(), from, from + width).w /
             width;
      sums_[static_cast<std::size_t>(bin) + 1] += sum;
    }
  }
}

double ExtinctionMeans::below(double position) const {
  const auto bin = static_cast<std::size_t>(std::clamp(position, 0.0, kExtinctionBins - 1.0));
  return sums_[bin] + (position - static_cast<double>(bin)) * (sums_[bin + 1] - sums_[bin]);
}

float ExtinctionMeans::operator()(float lowest, float highest) const {
  // At least a bin, so that ranges of one value have a mean too.
  double from = std::clamp((double{lowest} - first_) * binsPerValue_, 0.0, 1.0 * kExtinctionBins);
  double to = std::clamp((double{highest} - first_) * binsPerValue_, 0.0, 1.0 * kExtinctionBins);
  if (to < from + 1) {
    from = std::min(from, kExtinctionBins - 1.0);
    to = from + 1;
  }
  return static_cast<float>((below(to) - below(from)) / (to - from));
}

}  // namespace burin::node
