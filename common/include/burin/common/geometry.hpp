#pragma once

#include <cstddef>
#include <glm/glm.hpp>

namespace burin {

/// Half-open box of grid indices [lo, hi), of cells or of voxels as the name says.
struct IndexBox {
  glm::ivec3 lo{0};
  glm::ivec3 hi{0};

  glm::ivec3 size() const { return hi - lo; }
  bool empty() const { return hi.x <= lo.x || hi.y <= lo.y || hi.z <= lo.z; }
  /// Number of elements; 0 when empty.
  std::size_t count() const;
  bool contains(const IndexBox& other) const;
  friend bool operator==(const IndexBox&, const IndexBox&) = default;
};

/// Largest box inside both; `empty()` where they do not meet.
IndexBox intersection(const IndexBox& a, const IndexBox& b);

/// Closed box of real coordinates; the space is in the variable's name.
struct Box {
  glm::dvec3 lo{0};
  glm::dvec3 hi{0};
};

/// Where a volume's point samples lie in the world. Voxel (i,j,k) is a point sample at
/// origin + direction * (spacing ⊙ (i,j,k)). The volume fills the box from the first sample to the
/// last; an axis with one voxel is one spacing thick, centred on that sample.
///
/// *Index space* has one unit per voxel with (0,0,0) at the first sample. *Centred index space* is
/// index space minus `centreIndex()`: the space the renderer works in, so that floats stay small.
struct VolumeGrid {
  glm::ivec3 dims{1};
  glm::dvec3 origin{0};
  glm::dvec3 spacing{1};
  /// Columns are unit vectors, the world directions of the axes; at any angles to one another, in
  /// either handedness.
  glm::dmat3 direction{1};

  /// Voxels in the grid.
  std::size_t voxelCount() const;
  /// Cells along each axis: dims - 1, but at least 1 (an axis of one voxel is one cell thick).
  glm::ivec3 cells() const;
  /// The filled box in index space: [0, dims-1], or [-1/2, 1/2] for an axis of one voxel.
  Box boxIndex() const;
  /// The part of boxIndex() that a box of cells fills.
  Box cellBoxIndex(const IndexBox& cellRange) const;
  /// Centre of boxIndex().
  glm::dvec3 centreIndex() const;
  /// World vector of an index-space vector, and its inverse (no translation).
  glm::dmat3 indexToWorld() const;
  glm::dmat3 worldToIndex() const;
  glm::dvec3 worldFromIndex(const glm::dvec3& index) const;
  glm::dvec3 indexFromWorld(const glm::dvec3& world) const;
  glm::dvec3 centreWorld() const;
  /// Half the world length of the longest diagonal of the filled box: radius of the bounding
  /// sphere.
  double boundingRadius() const;
  double smallestSpacing() const;
};

}  // namespace burin
