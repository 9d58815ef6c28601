#pragma once

#include <optional>

#include "reference_volume.hpp"

namespace burin::node {

/// The gradient magnitudes (world units) that count as m = 1, by operator, found when first asked
/// for: a pass over all voxels that most scenes do not need, or only one of.
class ReferenceGradientScale {
 public:
  /// `percentiles`: used as given; unset ones: the exact one. `volume` must outlive this.
  ReferenceGradientScale(const ReferenceVolume& volume,
                         const PerGradientOperator<std::optional<double>>& percentiles)
      : volume_{volume}, percentiles_{percentiles} {}

  /// 99.9th percentile: the smallest magnitude that at least 99.9 % of the voxels do not exceed.
  double percentile(GradientOperator which);
  double maximum(GradientOperator which);

 private:
  const ReferenceVolume& volume_;
  PerGradientOperator<std::optional<double>> percentiles_;
  PerGradientOperator<std::optional<double>> maxima_;
};

}  // namespace burin::node
