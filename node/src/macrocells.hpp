#pragma once

#include <cstdint>
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

  /// Per macrocell 1 if visible(lowest, highest) says so of its range; x fastest.
  template <typename Visible>
  std::vector<std::uint8_t> mark(const Visible& visible) const {
    std::vector<std::uint8_t> marks(lowest_.size());
    for (std::size_t i = 0; i < marks.size(); ++i)
      marks[i] = lowest_[i] <= highest_[i] && visible(lowest_[i], highest_[i]) ? 1 : 0;
    return marks;
  }

  /// Cells (global) of the box around the marked macrocells; empty if none.
  IndexBox boxOf(std::span<const std::uint8_t> marks) const;

 private:
  std::size_t index(int x, int y, int z) const;

  glm::ivec3 firstCell_{0};
  glm::ivec3 size_{0};
  std::vector<float> lowest_;
  std::vector<float> highest_;
};

}  // namespace burin::node
