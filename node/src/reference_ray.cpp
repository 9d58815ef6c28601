#include "reference_ray.hpp"

#include <algorithm>
#include <limits>

namespace burin::node {
namespace {

/// Cuts the interval to where a + b * depth >= 0; leaves it empty (far < near) if nowhere.
void keepNonNegative(DepthInterval& interval, double a, double b) {
  if (b > 0)
    interval.near = std::max(interval.near, -a / b);
  else if (b < 0)
    interval.far = std::min(interval.far, -a / b);
  else if (a < 0)
    interval.far = -std::numeric_limits<double>::infinity();
}

}  // namespace

ReferenceRay referenceRay(const Camera& camera, int column, int row) {
  const double x = (column + 0.5 - camera.image.width / 2.0) * camera.pixelSize;
  const double y = (camera.image.height / 2.0 - (row + 0.5)) * camera.pixelSize;
  const glm::dvec3 offset = x * camera.right + y * camera.up;
  if (camera.projection == Projection::kOrthographic)
    return {camera.eyeWorld + offset, camera.forward, false};
  return {camera.eyeWorld, camera.forward + offset, true};
}

std::optional<DepthInterval> visibleInterval(const ReferenceRay& ray, const VolumeGrid& grid,
                                             const Scene& scene) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  DepthInterval interval{ray.startsAtEye ? 0 : -kEndless, kEndless};
  const Box box = grid.boxIndex();
  const glm::dvec3 origin = grid.indexFromWorld(ray.origin);
  const glm::dvec3 direction = grid.worldToIndex() * ray.direction;
  for (int axis = 0; axis < 3; ++axis) {
    keepNonNegative(interval, origin[axis] - box.lo[axis], direction[axis]);
    keepNonNegative(interval, box.hi[axis] - origin[axis], -direction[axis]);
  }
  for (const ClipPlane& plane : scene.clip)
    keepNonNegative(interval, glm::dot(plane.normal, ray.origin) + plane.offset,
                    glm::dot(plane.normal, ray.direction));
  if (scene.clipBox)
    for (int axis = 0; axis < 3; ++axis) {
      keepNonNegative(interval, ray.origin[axis] - scene.clipBox->min[axis], ray.direction[axis]);
      keepNonNegative(interval, scene.clipBox->max[axis] - ray.origin[axis], -ray.direction[axis]);
    }
  if (!(interval.near < interval.far)) return std::nullopt;
  return interval;
}

}  // namespace burin::node
