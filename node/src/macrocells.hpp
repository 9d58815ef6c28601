#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "burin/common/geometry.hpp"

namespace burin::node {

/// Cells along each side of a macrocell; kCell in skip.glsl.
inline constexpr int kMacrocellSize = 4;

/// Smallest and largest stored value of each macrocell that a brick's voxels touch, macrocells
/// being aligned to the global cell grid: macrocell c covers voxels [4c, 4c+4], faces shared.
/// Voxels arrive slab by slab; `finish` closes the ranges.
class Macrocells {
 public:
  /// `storedVoxels`: the voxel box of the brick's texture, ghosts included.
  explicit Macrocells(const IndexBox& storedVoxels);

  /// `stored`: values of the voxel box `box` in [0, 1], x fastest; NaN counts as nothing.
  void add(const IndexBox& box, std::span<const float> stored);

  /// Widens every range towards its neighbours' by 2^-8 of the difference: a look-up at a position
  /// that rounds across a macrocell's face (by at most 2048 * 2^-23 voxel in the texture unit)
  /// reads a value outside the macrocell's own range by at most that.
  void finish();

  glm::ivec3 size() const { return size_; }
  /// First voxel of the first macrocell, global index.
  glm::ivec3 origin() const { return kMacrocellSize * firstCell_; }
  std::size_t bytes() const { return (lowest_.size() + highest_.size()) * sizeof(float); }

  /// Per macrocell the chessboard distance (capped at 255) to the nearest macrocell whose range is
  /// `visible`; 0 where it is itself. x fastest.
  std::vector<std::uint8_t> distances(
      const std::function<bool(float lowest, float highest)>& visible) const;

  /// Cells (global) covered by the macrocells at distance 0; empty if none.
  IndexBox visibleCells(std::span<const std::uint8_t> distances) const;

 private:
  std::size_t index(int x, int y, int z) const;

  glm::ivec3 firstCell_{0};
  glm::ivec3 size_{0};
  std::vector<float> lowest_;
  std::vector<float> highest_;
};

}  // namespace burin::node
