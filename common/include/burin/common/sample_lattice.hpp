#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "burin/common/camera.hpp"
#include "burin/common/geometry.hpp"

namespace burin {

/// The global planar sample lattice of one view, in centred index space: the only description of
/// sample positions that the ray-cast program gets, evaluated in double, stored relative to the box
/// centre so that floats suffice at any distance of the eye.
///
/// Lattice plane k lies at eye depth k * stepWorld, perpendicular to the view direction. With
/// j = k - reference, the position on plane j of pixel coordinates (fx, fy), measured in pixels
/// from the image centre with fx to the right and fy *down*, is
///   p(j) = base + fx*baseX + fy*baseY + j * (step + fx*stepX + fy*stepY).
/// The ray's world length per plane is stepWorld * |forward + x right + y up|.
struct SampleLattice {
  glm::dvec3 base, baseX, baseY;
  glm::dvec3 step, stepX, stepY;
  double stepWorld = 0;   ///< distance of lattice planes in world units
  double pixelSlope = 0;  ///< perspective: pixelSize; orthographic: 0 (all rays parallel)
  double nearPlane = 0;   ///< smallest allowed j: perspective: the eye's own plane; else -infinity
  std::int64_t reference = 0;  ///< k of plane j = 0, the plane nearest the box centre
};

/// Lattice of a view. `stepVoxels` (> 0) is in multiples of the smallest spacing. Throws
/// Error{kUsage} if the eye is so far away that doubles cannot count the planes.
SampleLattice makeSampleLattice(const Camera& camera, const VolumeGrid& grid, double stepVoxels);

}  // namespace burin
