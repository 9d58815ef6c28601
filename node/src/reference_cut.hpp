#pragma once

#include <glm/glm.hpp>

#include "burin/common/scene.hpp"

namespace burin::node {

/// What of a sample's surface is a cut by clip planes.
struct ReferenceCut {
  glm::dvec3 inward{0};  ///< unit, world, to what is kept; zero where there is no cut
  double share = 0;      ///< 1 up to kCapVoxels from a plane, falling to 0 at twice that
};

/// At a world position on the kept side. `voxel`: the volume's smallest spacing.
ReferenceCut referenceCut(const Scene& scene, const glm::dvec3& world, double voxel);

}  // namespace burin::node
