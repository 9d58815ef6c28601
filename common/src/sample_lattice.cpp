#include "burin/common/sample_lattice.hpp"

#include <cmath>
#include <limits>

#include "burin/common/error.hpp"

namespace burin {

SampleLattice makeSampleLattice(const Camera& camera, const VolumeGrid& grid, double stepVoxels) {
  BURIN_CHECK(stepVoxels > 0);
  const bool perspective = camera.projection == Projection::kPerspective;
  const glm::dmat3 toIndex = grid.worldToIndex();
  const glm::dvec3 right = toIndex * camera.right;
  const glm::dvec3 down = -(toIndex * camera.up);
  const glm::dvec3 forward = toIndex * camera.forward;

  SampleLattice lattice;
  lattice.stepWorld = stepVoxels * grid.smallestSpacing();
  lattice.pixelSlope = perspective ? camera.pixelSize : 0.0;

  const glm::dvec3 eyeToCentre = grid.centreWorld() - camera.eyeWorld;
  const double centreDepth = glm::dot(eyeToCentre, camera.forward);
  const double plane = std::round(centreDepth / lattice.stepWorld);
  if (!(std::abs(plane) < 0x1p53)) {
    fail(ExitCode::kUsage,
         "camera: the eye is {:g} sample planes away from the volume, expected less than 2^53",
         plane);
  }
  lattice.reference = static_cast<std::int64_t>(plane);
  lattice.nearPlane = perspective ? static_cast<double>(-lattice.reference)
                                  : -std::numeric_limits<double>::infinity();

  // base = eye + plane * step - centre, sideways and along the view apart: each part is small by
  // itself, so the distance of the eye cancels here, in double, and nowhere later.
  const double planeDepth = plane * lattice.stepWorld;
  const glm::dvec3 sideways = camera.forward * centreDepth - eyeToCentre;
  const double along = std::fma(plane, lattice.stepWorld, -centreDepth);
  lattice.base = toIndex * sideways + forward * along;
  lattice.step = forward * lattice.stepWorld;

  // Per pixel: perspective rays spread in proportion to depth, parallel ones do not spread.
  const double pixelAtBase = perspective ? camera.pixelSize * planeDepth : camera.pixelSize;
  const double pixelPerStep = lattice.pixelSlope * lattice.stepWorld;
  lattice.baseX = right * pixelAtBase;
  lattice.baseY = down * pixelAtBase;
  lattice.stepX = right * pixelPerStep;
  lattice.stepY = down * pixelPerStep;
  return lattice;
}

}  // namespace burin
