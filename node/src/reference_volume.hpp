#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <variant>
#include <vector>

#include "burin/node/brick_source.hpp"

namespace burin::node {

/// The whole volume as the reference renderer sees it: native voxels, interpolated in double.
class ReferenceVolume {
 public:
  /// Reads all voxels. ±Inf voxels become the ends of the finite range (0 if nothing is finite).
  explicit ReferenceVolume(BrickSource& source);

  const VolumeGrid& grid() const { return grid_; }
  bool hasNan() const { return hasNan_; }

  /// Trilinear value at a position in index space, clamped to the grid. Nothing where less than
  /// half of the interpolation weight falls on voxels that are not NaN; else NaN voxels do not
  /// count.
  std::optional<double> valueAt(const glm::dvec3& index) const;

  /// ∇f at a position in index space, per world unit: central differences of valueAt over ±1 voxel
  /// along each axis. Zero where one of the six values is missing: no direction is known there.
  glm::dvec3 gradientAt(const glm::dvec3& index) const;

  /// |∇f| per world unit at every voxel, unordered; voxels that are NaN or touch one do not count.
  std::vector<double> gradientMagnitudes() const;

 private:
  using Voxels = std::variant<std::vector<std::uint8_t>, std::vector<std::int16_t>,
                              std::vector<std::uint16_t>, std::vector<float>>;

  void cleanFloats();

  VolumeGrid grid_;
  glm::dmat3 worldFromIndexGradient_{1};
  Voxels voxels_;
  bool hasNan_ = false;
};

}  // namespace burin::node
