#pragma once

#include <optional>

#include "reference_volume.hpp"

namespace burin::node {

/// The gradient magnitudes (world units) that count as m = 1, found when first asked for: a pass
/// over all voxels that most scenes do not need, or only one of.
class ReferenceGradientScale {
 public:
  /// `percentile`: used as given; unset: the exact one. `volume` must outlive this.
  ReferenceGradientScale(const ReferenceVolume& volume, const std::optional<double>& percentile)
      : volume_{volume}, percentile_{percentile} {}

  /// 99.9th percentile: the smallest magnitude that at least 99.9 % of the voxels do not exceed.
  double percentile();
  double maximum();

 private:
  const ReferenceVolume& volume_;
  std::optional<double> percentile_;
  std::optional<double> maximum_;
};

}  // namespace burin::node
