#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "reference_ray.hpp"
#include "reference_volume.hpp"

namespace burin::node {

/// Depths in `interval`, both its ends included and ascending, between which the volume is smooth
/// along a ray and its value rises or falls all the way: the faces of cells, and within a cell the
/// extremes of the cubic that a trilinear field is along a line. A cell that touches NaN voxels is
/// not cut at extremes. `origin + depth * direction` in index space.
std::vector<double> smoothPieces(const ReferenceVolume& volume, const glm::dvec3& origin,
                                 const glm::dvec3& direction, const DepthInterval& interval);

}  // namespace burin::node
