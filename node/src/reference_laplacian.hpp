#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference_volume.hpp"

namespace burin::node {

/// ∇²(G * f) of a volume in world units, over the 99.9th percentile of its magnitude, in [-1, 1]: G
/// the binomial 1-4-6-4-1 along each index axis, second differences at the voxels, in between
/// trilinear. Beyond the volume the nearest voxel's value holds; 0 at voxels with a NaN within
/// three voxels along every axis.
class ReferenceLaplacian {
 public:
  /// `percentile`: used as given; unset: the exact one.
  ReferenceLaplacian(const ReferenceVolume& volume, const std::optional<double>& percentile);

  /// At a position in index space.
  double at(const glm::dvec3& index) const;

 private:
  double voxel(const glm::ivec3& at) const;

  glm::ivec3 dims_;
  std::vector<double> voxels_;
  double percentile_ = 0;
};

}  // namespace burin::node
