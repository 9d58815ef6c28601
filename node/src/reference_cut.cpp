#include "reference_cut.hpp"

#include <algorithm>

namespace burin::node {
namespace {

/// Planes meet in rounded edges: their directions mix by their shares.
void add(ReferenceCut& cut, const glm::dvec3& inward, double voxels) {
  const double share = std::clamp(2 - voxels / kCapVoxels, 0.0, 1.0);
  cut.inward += share * inward;
  cut.share = std::max(cut.share, share);
}

}  // namespace

ReferenceCut referenceCut(const Scene& scene, const glm::dvec3& world, double voxel) {
  ReferenceCut cut;
  for (const ClipPlane& plane : scene.clip) {
    const double length = glm::length(plane.normal);
    if (plane.hasCap)
      add(cut, plane.normal / length,
          (glm::dot(plane.normal, world) + plane.offset) / (length * voxel));
  }
  if (scene.clipBox && scene.clipBox->hasCap) {
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 unit{0};
      unit[axis] = 1;
      add(cut, unit, (world[axis] - scene.clipBox->min[axis]) / voxel);
      add(cut, -unit, (scene.clipBox->max[axis] - world[axis]) / voxel);
    }
  }
  const double length = glm::length(cut.inward);
  if (length > 0) cut.inward /= length;
  return cut;
}

}  // namespace burin::node
