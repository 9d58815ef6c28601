#include "burin/common/footprint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "burin/common/error.hpp"

namespace burin {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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

/// The corners of the part of a box that lies at those depths: its own corners there, and where its
/// edges meet the two planes.
std::vector<glm::dvec3> slabCorners(const std::array<glm::dvec3, 8>& box, const glm::dvec3& forward,
                                    const DepthRange& depths) {
  std::vector<glm::dvec3> corners;
  for (unsigned i = 0; i < 8; ++i) {
    const double from = glm::dot(box[i], forward);
    if (from >= depths.nearest && from <= depths.farthest) corners.push_back(box[i]);
    for (unsigned bit = 1; bit < 8; bit *= 2) {
      if ((i & bit) != 0) continue;
      const double to = glm::dot(box[i | bit], forward);
      for (const double plane : {depths.nearest, depths.farthest})
        if (std::min(from, to) < plane && plane < std::max(from, to))
          corners.push_back(glm::mix(box[i], box[i | bit], (plane - from) / (to - from)));
    }
  }
  return corners;
}

/// Pixels around points that are given from the eye; the whole image if some are beside or behind a
/// perspective eye, none if all of them are behind it.
PixelRect rectAround(const Camera& camera, const VolumeGrid& grid,
                     std::span<const glm::dvec3> pointsFromEye) {
  const bool perspective = camera.projection == Projection::kPerspective;
  const double nearest = 1e-9 * grid.boundingRadius();  // nearer than this, x / depth says nothing
  glm::dvec2 lo{kInfinity};
  glm::dvec2 hi{-kInfinity};
  std::size_t behind = 0;
  std::size_t near = 0;
  for (const glm::dvec3& point : pointsFromEye) {
    const double depth = glm::dot(point, camera.forward);
    behind += depth < 0 ? 1 : 0;
    near += depth < nearest ? 1 : 0;
    const double scale = 1.0 / (camera.pixelSize * (perspective ? depth : 1.0));
    const glm::dvec2 pixel{glm::dot(point, camera.right) * scale + 0.5 * camera.image.width,
                           0.5 * camera.image.height - glm::dot(point, camera.up) * scale};
    lo = glm::min(lo, pixel);
    hi = glm::max(hi, pixel);
  }
  if (perspective && behind == pointsFromEye.size()) return {};
  if (perspective && near > 0) return {0, 0, camera.image.width, camera.image.height};
  const Range x = pixelRange(lo.x, hi.x, camera.image.width);
  const Range y = pixelRange(lo.y, hi.y, camera.image.height);
  const PixelRect rect{x.begin, y.begin, x.end, y.end};
  return rect.empty() ? PixelRect{} : rect;
}

}  // namespace

DepthRange depthRange(const Camera& camera, const VolumeGrid& grid, const IndexBox& cells) {
  BURIN_CHECK(!cells.empty());
  DepthRange range{kInfinity, -kInfinity};
  for (const glm::dvec3& corner : cornersFromEye(camera, grid, cells)) {
    const double depth = glm::dot(corner, camera.forward);
    range = {std::min(range.nearest, depth), std::max(range.farthest, depth)};
  }
  return range;
}

PixelRect footprint(const Camera& camera, const VolumeGrid& grid, const IndexBox& cells) {
  if (cells.empty()) return {};
  return rectAround(camera, grid, cornersFromEye(camera, grid, cells));
}

PixelRect footprint(const Camera& camera, const VolumeGrid& grid, const IndexBox& cells,
                    const DepthRange& depths) {
  if (cells.empty()) return {};
  const std::vector<glm::dvec3> corners =
      slabCorners(cornersFromEye(camera, grid, cells), camera.forward, depths);
  return corners.empty() ? PixelRect{} : rectAround(camera, grid, corners);
}

}  // namespace burin
