#include "burin/common/footprint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace burin {

namespace {

std::array<glm::dvec3, 8> cornersFromEye(const Camera& camera, const VolumeGrid& grid,
                                         const IndexBox& cells) {
  // Samples lie up to about 1e-4 voxel beside their exact ray (float arithmetic, 2048 voxels);
  // under a strong zoom that is many pixels.
  constexpr double kPositionError = 1e-3;
  const Box box = grid.cellBoxIndex(cells);
  const glm::dvec3 lo = box.lo - kPositionError;
  const glm::dvec3 hi = box.hi + kPositionError;
  std::array<glm::dvec3, 8> corners;
  for (unsigned i = 0; i < 8; ++i) {
    const glm::dvec3 index{(i & 1u) != 0 ? hi.x : lo.x, (i & 2u) != 0 ? hi.y : lo.y,
                           (i & 4u) != 0 ? hi.z : lo.z};
    corners[i] = grid.worldFromIndex(index) - camera.eyeWorld;
  }
  return corners;
}

/// Pixels of one axis whose centres lie between two positions (in pixels from the image's low
/// edge), with one more on each side for rounding.
struct Range {
  int begin;
  int end;
};
Range pixelRange(double lo, double hi, int size) {
  const double limit = size;
  return {static_cast<int>(std::clamp(std::floor(lo - 0.5) - 1.0, 0.0, limit)),
          static_cast<int>(std::clamp(std::ceil(hi - 0.5) + 2.0, 0.0, limit))};
}

}  // namespace

PixelRect footprint(const Camera& camera, const VolumeGrid& grid, const IndexBox& cells) {
  if (cells.empty()) return {};
  const bool perspective = camera.projection == Projection::kPerspective;
  const double nearest = 1e-9 * grid.boundingRadius();  // nearer than this, x / depth says nothing
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  glm::dvec2 lo{kInfinity};
  glm::dvec2 hi{-kInfinity};
  int behind = 0;
  int near = 0;
  for (const glm::dvec3& corner : cornersFromEye(camera, grid, cells)) {
    const double depth = glm::dot(corner, camera.forward);
    behind += depth < 0 ? 1 : 0;
    near += depth < nearest ? 1 : 0;
    const double scale = 1.0 / (camera.pixelSize * (perspective ? depth : 1.0));
    const glm::dvec2 pixel{glm::dot(corner, camera.right) * scale + 0.5 * camera.image.width,
                           0.5 * camera.image.height - glm::dot(corner, camera.up) * scale};
    lo = glm::min(lo, pixel);
    hi = glm::max(hi, pixel);
  }
  if (perspective && behind == 8) return {};
  if (perspective && near > 0) return {0, 0, camera.image.width, camera.image.height};
  const Range x = pixelRange(lo.x, hi.x, camera.image.width);
  const Range y = pixelRange(lo.y, hi.y, camera.image.height);
  const PixelRect rect{x.begin, y.begin, x.end, y.end};
  return rect.empty() ? PixelRect{} : rect;
}

}  // namespace burin
