#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "burin/common/geometry.hpp"
#include "burin/common/scene.hpp"

namespace burin::node {

/// The scene's clip planes and its box's faces in centred index space, (normal, offset) with a unit
/// normal: what the program's clipPlane holds, and what else asks what is clipped.
std::vector<glm::vec4> centredClipPlanes(const Scene& scene, const VolumeGrid& grid);

/// A regular grid of cubes of cells over a part of the volume: macrocells, or the survey's blocks.
struct CubeGrid {
  glm::ivec3 origin{0};  ///< first cell of the first cube, global index
  glm::ivec3 size{0};    ///< cubes along each axis
  int cubeCells = 1;     ///< cells along each side of a cube

  /// Where a cube's value stands, x fastest.
  std::size_t index(const glm::ivec3& cube) const {
    const auto row = static_cast<std::size_t>(cube.z) * static_cast<std::size_t>(size.y) +
                     static_cast<std::size_t>(cube.y);
    return row * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(cube.x);
  }
};

/// Local. Sets the marks (x fastest) of all cubes to 0 that lie behind a plane as a whole, and so
/// far behind it that no sample of a ray which the program clips at that plane can lie in one.
/// `planes`: as above. O(rows) for each plane.
void clearClipped(std::span<std::uint8_t> marks, const CubeGrid& cubes,
                  std::span<const glm::vec4> planes, const VolumeGrid& grid);

}  // namespace burin::node
