#include "view_rays.hpp"

#include <algorithm>
#include <cmath>

namespace burin::node {
namespace {

/// Share of [at - radius, at + radius] that lies in [-half, half].
double shareInside(double at, double radius, double half) {
  return std::clamp((half + radius - std::abs(at)) / (2 * radius), 0.0, 1.0);
}

}  // namespace

std::vector<float> raysPerCell(const Camera& view, const CubeGrid& blocks, const VolumeGrid& grid) {
  const bool isParallel = view.projection == Projection::kOrthographic;
  const glm::dmat3 toView = glm::transpose(glm::dmat3{view.right, view.up, view.forward});
  const double side = blocks.cubeCells;
  const glm::dmat3 step = toView * (side * grid.indexToWorld());
  const glm::dvec3 firstIndex = glm::dvec3{blocks.origin} + 0.5 * side;
  const glm::dvec3 first = toView * (grid.worldFromIndex(firstIndex) - view.eyeWorld);
  const double radius = 0.5 * std::cbrt(std::abs(glm::determinant(step)));
  const double centreDepth =
      std::max(glm::dot(grid.centreWorld() - view.eyeWorld, view.forward), radius);
  const double halfWidth = 0.5 * view.image.width * view.pixelSize;
  const double halfHeight = 0.5 * view.image.height * view.pixelSize;
  const auto raysAt = [&](const glm::dvec3& at) {
    if (isParallel)
      return shareInside(at.x, radius, halfWidth) * shareInside(at.y, radius, halfHeight);
    if (at.z < -radius) return 0.0;
    const double depth = std::max(at.z, radius);
    return shareInside(at.x, radius, halfWidth * depth) *
           shareInside(at.y, radius, halfHeight * depth) * (centreDepth / depth) *
           (centreDepth / depth);
  };
  std::vector<float> rays;
  rays.reserve(IndexBox{glm::ivec3{0}, blocks.size}.count());
  for (int z = 0; z < blocks.size.z; ++z)
    for (int y = 0; y < blocks.size.y; ++y)
      for (int x = 0; x < blocks.size.x; ++x)
        rays.push_back(static_cast<float>(raysAt(first + step * glm::dvec3{x, y, z})));
  return rays;
}

}  // namespace burin::node
