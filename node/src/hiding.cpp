#include "hiding.hpp"

#include <algorithm>
#include <cmath>

#include "burin/common/error.hpp"
#include "burin/common/footprint.hpp"

namespace burin::node {
namespace {

/// position(t) = origin + t * along for t from begin to end; in blocks from the first one's corner,
/// t in steps.
struct CoarseRay {
  glm::dvec3 origin, along;
  double begin, end;
};

/// A view's rays.
class CoarseRays {
 public:
  CoarseRays(const Camera& view, const VolumeGrid& grid, const CubeGrid& blocks, double stepWorld)
      : view_{view},
        size_{blocks.size},
        toBlocks_{grid.worldToIndex() / static_cast<double>(blocks.cubeCells)},
        eye_{(grid.indexFromWorld(view.eyeWorld) - glm::dvec3{blocks.origin}) /
             static_cast<double>(blocks.cubeCells)},
        stepWorld_{stepWorld} {}

  /// Through a place of the picture, in pixels.
  CoarseRay through(double column, double row) const {
    constexpr double kFar = 1e30;
    const glm::dvec3 across = (column - 0.5 * view_.image.width) * view_.pixelSize * view_.right +
                              (0.5 * view_.image.height - row) * view_.pixelSize * view_.up;
    if (view_.projection == Projection::kOrthographic)
      return clipped(
          {eye_ + toBlocks_ * across, stepWorld_ * (toBlocks_ * view_.forward), -kFar, kFar});
    return clipped(
        {eye_, stepWorld_ * (toBlocks_ * glm::normalize(view_.forward + across)), 0, kFar});
  }

 private:
  CoarseRay clipped(CoarseRay ray) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (ray.along[axis] == 0) {
        if (ray.origin[axis] < 0 || ray.origin[axis] > size_[axis]) ray.end = ray.begin;
        continue;
      }
      const double toLow = -ray.origin[axis] / ray.along[axis];
      const double toHigh = (size_[axis] - ray.origin[axis]) / ray.along[axis];
      ray.begin = std::max(ray.begin, std::min(toLow, toHigh));
      ray.end = std::min(ray.end, std::max(toLow, toHigh));
    }
    return ray;
  }

  const Camera& view_;
  glm::ivec3 size_;
  glm::dmat3 toBlocks_;
  glm::dvec3 eye_;
  double stepWorld_;
};

/// The shortest side of a block; where spacings differ much, what keeps a ray's steps to three for
/// each block of the longest axis.
double stepOf(const VolumeGrid& grid, const CubeGrid& blocks) {
  const int longest = std::max({blocks.size.x, blocks.size.y, blocks.size.z});
  return std::max(blocks.cubeCells * grid.smallestSpacing(),
                  2 * grid.boundingRadius() / (3.0 * longest));
}

/// Rays that came to a block, and those of them that were not opaque yet.
struct Arrivals {
  std::uint32_t rays = 0;
  std::uint32_t seeing = 0;
};

}  // namespace

std::vector<float> shareNotHidden(const Camera& view, const VolumeGrid& grid,
                                  const RayBlocks& blocks, double termination, int across) {
  BURIN_CHECK(termination > 0);
  const double enough = -std::log(termination);
  const double stepWorld = stepOf(grid, blocks.cubes);
  const glm::dvec3 last{blocks.cubes.size - 1};
  std::vector<Arrivals> arrivals(blocks.extinction.size());
  const auto march = [&](const CoarseRay& ray) {
    double depth = 0;  // optical, of the brick that the ray is in
    std::uint32_t brick = ~std::uint32_t{0};
    const auto steps = static_cast<int>(std::ceil(std::max(0.0, ray.end - ray.begin - 0.5)));
    for (int step = 0; step < steps; ++step) {
      const double t = ray.begin + step + 0.5;
      const glm::dvec3 at = glm::floor(ray.origin + t * ray.along);
      const std::size_t i = blocks.cubes.index(glm::ivec3{glm::clamp(at, glm::dvec3{0}, last)});
      if (blocks.brick[i] != brick) depth = 0;
      brick = blocks.brick[i];
      ++arrivals[i].rays;
      arrivals[i].seeing += depth < enough ? 1 : 0;
      depth += stepWorld * double{blocks.extinction[i]};
    }
  };
  const CoarseRays rays{view, grid, blocks.cubes, stepWorld};
  const PixelRect part = footprint(view, grid, {glm::ivec3{0}, grid.cells()});
  for (int row = 0; row < across; ++row)
    for (int column = 0; column < across; ++column)
      march(rays.through(part.x0 + (column + 0.5) * part.width() / across,
                         part.y0 + (row + 0.5) * part.height() / across));
  std::vector<float> shares;
  shares.reserve(arrivals.size());
  for (const Arrivals& block : arrivals)
    shares.push_back(
        block.rays == 0 ? 1.0f : static_cast<float>(block.seeing) / static_cast<float>(block.rays));
  return shares;
}

}  // namespace burin::node
