#pragma once

#include <span>

#include "burin/common/scene.hpp"
#include "reference_volume.hpp"

namespace burin::node {

/// A segmentation as the reference renderer sees it.
class ReferenceLabels {
 public:
  /// Reads all voxels.
  explicit ReferenceLabels(BrickSource& source) : voxels_{source} {}

  /// How far a position in index space belongs to a layer, 0 … 1: the trilinear interpolation of 1
  /// at voxels with one of the layer's `labels` (numbers) and 0 at the others; 1 for a layer
  /// without labels.
  double membership(std::span<const LabelName> labels, const glm::dvec3& index) const;

 private:
  ReferenceVolume voxels_;
};

}  // namespace burin::node
