#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "burin/common/geometry.hpp"
#include "clip_planes.hpp"
#include "macrocell_ranges.hpp"
#include "octant_plane.hpp"

namespace burin::node {

/// Cells along each side of a macrocell; kCell in skip.glsl. Its octants are half as wide.
inline constexpr int kMacrocellSize = 4;

/// Value ranges of the macrocells that a brick's voxels touch, and of their octants, macrocells
/// being aligned to the global cell grid: macrocell c covers voxels [4c, 4c+4], faces shared.
/// Voxels arrive slab by slab; `finish` closes the ranges.
class Macrocells {
 public:
  /// `storedVoxels`: the voxel box of the brick's texture, ghosts included. `isWhole`: as of
  /// MacrocellRanges.
  Macrocells(const IndexBox& storedVoxels, bool isWhole);

  /// `stored`: values of the voxel box `box` in [0, 1], x fastest; NaN counts as nothing. Boxes are
  /// slabs, whole in x and y, in ascending z.
  void add(const IndexBox& box, std::span<const float> stored);

  /// After the last add().
  void finish();

  glm::ivec3 size() const { return size_; }
  /// First voxel of the first macrocell, global index.
  glm::ivec3 origin() const { return kMacrocellSize * firstCell_; }
  CubeGrid cubes() const { return {origin(), size_, kMacrocellSize}; }
  std::size_t bytes() const { return ranges_.bytes(); }

  /// Per macrocell (x fastest) its octants that may show something: MacrocellRanges::mark().
  template <typename Visible>
  std::vector<OctantMask> mark(const Visible& visible) const {
    return ranges_.mark(visible);
  }

  /// Cells (global) of the box around the marked macrocells; empty if none.
  IndexBox boxOf(std::span<const OctantMask> marks) const;

 private:
  OctantPlane& plane(int number);
  void keepBefore(int voxelFromFirst);
  void keepNext();
  void widenedRow(int y, int z, OctantRow& row);

  glm::ivec3 firstCell_{0};
  glm::ivec3 size_{0};
  std::deque<OctantPlane> planes_;  ///< along z, those that are still needed
  int firstPlane_ = 0;              ///< the number of the first of them
  int kept_ = 0;                    ///< layers of macrocells along z whose ranges are known
  MacrocellRanges ranges_;
};

}  // namespace burin::node
