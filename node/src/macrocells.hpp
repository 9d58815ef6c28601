#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burin/common/geometry.hpp"
#include "clip_planes.hpp"
#include "value_ranges.hpp"

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

  /// Widens the ranges. After the last add().
  void finish() { ranges_.widen(); }

  glm::ivec3 size() const { return size_; }
  /// First voxel of the first macrocell, global index.
  glm::ivec3 origin() const { return kMacrocellSize * firstCell_; }
  CubeGrid cubes() const { return {origin(), size_, kMacrocellSize}; }
  std::size_t bytes() const { return ranges_.bytes(); }

  /// Per macrocell 1 if visible(lowest, highest) says so of its range; x fastest.
  template <typename Visible>
  std::vector<std::uint8_t> mark(const Visible& visible) const {
    return ranges_.mark(visible);
  }

  /// Cells (global) of the box around the marked macrocells; empty if none.
  IndexBox boxOf(std::span<const std::uint8_t> marks) const;

 private:
  std::size_t index(int x, int y, int z) const;

  glm::ivec3 firstCell_{0};
  glm::ivec3 size_{0};
  ValueRanges ranges_;
};

}  // namespace burin::node
