#include "clip_planes.hpp"

#include <algorithm>
#include <cmath>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

/// Voxels by which samples may lie behind a plane that clips their ray. The program's distances
/// from a plane and along a ray round about 16 times by 2^-24 of |origin| + R, in voxels: R the
/// volume's radius, |origin| <= R (1 + 1 / cos a) where the ray meets the plane through the centre,
/// a its angle to the view direction. 2^-12 R covers angles of up to 89 degrees; a quarter of a
/// voxel besides costs nothing that counts, as cubes are some voxels wide.
double clipMargin(const VolumeGrid& grid) {
  const Box box = grid.boxIndex();
  return 0.25 + 0x1p-12 * 0.5 * glm::length(box.hi - box.lo);
}

struct Run {
  int begin, end;
};

/// The x of [0, count) with height + x * rise < 0.
Run below0(double height, double rise, int count) {
  if (rise == 0) return {0, height < 0 ? count : 0};
  const double zero = -height / rise;
  if (rise > 0) return {0, static_cast<int>(std::ceil(std::clamp(zero, 0.0, 1.0 * count)))};
  return {static_cast<int>(std::floor(std::clamp(zero, -1.0, count - 1.0))) + 1, count};
}

}  // namespace

std::vector<glm::vec4> centredClipPlanes(const Scene& scene, const VolumeGrid& grid) {
  std::vector<glm::vec4> planes;
  for (const ClipPlane& plane : clipPlanes(scene)) {
    // n·x + d with x = centreWorld + M p: the plane in centred index space, scaled to unit length.
    const glm::dvec3 normal = glm::transpose(grid.indexToWorld()) * plane.normal;
    const double offset = glm::dot(plane.normal, grid.centreWorld()) + plane.offset;
    planes.emplace_back(glm::vec4{glm::dvec4{normal, offset} / glm::length(normal)});
  }
  return planes;
}

void clearClipped(std::span<std::uint8_t> marks, const CubeGrid& cubes,
                  std::span<const glm::vec4> planes, const VolumeGrid& grid) {
  BURIN_CHECK_EQ(marks.size(), (IndexBox{glm::ivec3{0}, cubes.size}.count()));
  const double side = cubes.cubeCells;
  const double margin = clipMargin(grid);
  // Where there is one voxel along an axis, its cell reaches half a voxel to either side of it.
  const glm::dvec3 first = glm::dvec3{cubes.origin} - grid.centreIndex() -
                           glm::dvec3{glm::equal(grid.dims, glm::ivec3{1})} * 0.5;
  for (const glm::vec4& plane : planes) {
    const glm::dvec3 normal{plane};
    const glm::dvec3 highestCorner =
        first + side * glm::dvec3{glm::greaterThan(normal, glm::dvec3{0})};
    const double height = glm::dot(normal, highestCorner) + double{plane.w} + margin;
    const glm::dvec3 rise = side * normal;  // of `height`, per cube
    auto row = marks.begin();
    for (int z = 0; z < cubes.size.z; ++z)
      for (int y = 0; y < cubes.size.y; ++y, row += cubes.size.x) {
        const Run behind = below0(height + z * rise.z + y * rise.y, rise.x, cubes.size.x);
        std::fill(row + behind.begin, row + behind.end, std::uint8_t{0});
      }
  }
}

}  // namespace burin::node
