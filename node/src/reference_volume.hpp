#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <variant>
#include <vector>

#include "burin/common/gradient_operator.hpp"
#include "burin/node/brick_source.hpp"

namespace burin::node {

/// The whole volume as the reference renderer sees it: native voxels, interpolated in double.
class ReferenceVolume {
 public:
  /// Reads all voxels. ±Inf voxels become the ends of the finite range (0 if nothing is finite).
  explicit ReferenceVolume(BrickSource& source);

  const VolumeGrid& grid() const { return grid_; }
  bool hasNan() const { return hasNan_; }

  /// As the grid's, whose inverse matrix is computed once here.
  glm::dvec3 indexFromWorld(const glm::dvec3& world) const {
    return indexFromWorld_ * (world - grid_.origin);
  }

  /// The voxel nearest to an index; may be NaN.
  double voxelAt(const glm::ivec3& index) const;

  /// Trilinear value at a position in index space, clamped to the grid. Nothing where less than
  /// half of the interpolation weight falls on voxels that are not NaN; else NaN voxels do not
  /// count.
  std::optional<double> valueAt(const glm::dvec3& index) const;

  /// ∇f at a position in index space, per world unit, from valueAt at ±1 voxel. Zero where one of
  /// the values that count is missing: no direction is known there.
  ///
  /// Central: differences along each axis. Sobel: the same, averaged with weights 1-2-1 along both
  /// other axes. Regression: the gradient of the linear function nearest to the 27 values in the
  /// sense of least squares, weighted by the reciprocal of their distance (Neumann, Csébfalvi,
  /// König, Gröller, "Gradient Estimation in Volume Data using 4D Linear Regression", Eurographics
  /// 2000).
  glm::dvec3 gradientAt(const glm::dvec3& index, GradientOperator which) const;

  /// |∇f| per world unit at every voxel, unordered; voxels that are NaN, or of whose neighbours
  /// that count one is, do not count.
  std::vector<double> gradientMagnitudes(GradientOperator which) const;

 private:
  using Voxels = std::variant<std::vector<std::uint8_t>, std::vector<std::int16_t>,
                              std::vector<std::uint16_t>, std::vector<float>>;

  void cleanFloats();

  VolumeGrid grid_;
  glm::dmat3 indexFromWorld_{1};
  glm::dmat3 worldFromIndexGradient_{1};
  Voxels voxels_;
  bool hasNan_ = false;
};

}  // namespace burin::node
