#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

#include "burin/common/geometry.hpp"

namespace burin::node {

/// Voxels that the Laplacian at a voxel reaches to along each axis.
inline constexpr int kLaplacianReach = 3;

/// ∇²(G * f) in world units at the voxels of a box whose z slices come in ascending order. G is the
/// binomial 1-4-6-4-1 along each axis, a Gaussian of one voxel: second differences of the values
/// themselves show their noise and nothing else. Voxels beyond the box count as the nearest in it,
/// so what is within kLaplacianReach of a face inside the volume is not the volume's own.
class SmoothedLaplacian {
 public:
  /// Receives z, counted from the box's first slice, and the values there in units of unit(), x
  /// fastest; NaN where one is within kLaplacianReach along every axis.
  using Deliver = std::function<void(int, std::span<const float>)>;

  /// `size`: voxels of the box. `grid`: the volume's, whose spacing and axes count.
  SmoothedLaplacian(const glm::ivec3& size, const VolumeGrid& grid);

  /// Per squared world unit, so that a float holds the result at every spacing.
  double unit() const { return unit_; }

  /// The next slice; delivers those that are known now: all after the last.
  void add(std::span<const float> slice, const Deliver& deliver);

 private:
  static constexpr int kTaps = 2 * kLaplacianReach + 1;
  using Taps = std::array<float, kTaps>;
  using Slice = std::vector<float>;
  static const Taps kSmooth, kFirst, kSecond;

  /// A slice filtered along x and y, by what remains to be done along z.
  struct Plane {
    Slice toSmooth, toDeriveOnce, toDeriveTwice;
  };

  void filterAlongX(std::span<const float> slice);
  void filterAlongY(Plane& plane) const;
  void addRows(const Slice& from, const Taps& taps, double factor, Slice& to) const;
  void filterAlongZ(int z);

  glm::ivec3 size_;
  double unit_ = 1;
  glm::dmat3 metric_;  ///< ∇² = unit Σ metric_ab ∂a ∂b over index axes
  Slice smoothX_, firstX_, secondX_;
  std::array<Plane, kTaps> planes_;  ///< of slice z: z modulo kTaps
  Slice result_;
  int added_ = 0;
  int delivered_ = 0;
};

}  // namespace burin::node
