#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "burin/common/gradient_operator.hpp"
#include "burin/node/brick_source.hpp"
#include "operator_weights.hpp"

namespace burin::node {

/// Counts of magnitudes in bins of relative width 2^-10: the sign, exponent and first ten mantissa
/// bits of a float number the bins.
class MagnitudeHistogram {
 public:
  MagnitudeHistogram();
  void add(float magnitude);
  void addZeros(std::int64_t count);
  /// For sums over ranks. The first entry counts exact zeros.
  std::span<std::int64_t> counts() { return counts_; }
  /// Upper edge of the bin below which `fraction` of all magnitudes lie; 0 if there are none or if
  /// so many are exactly 0.
  double percentile(double fraction) const;

 private:
  std::vector<std::int64_t> counts_;
};

/// Gradient magnitudes in world units, by one operator, of z slices that come in ascending order:
/// those of the slices [firstZ, lastZ), whose neighbours come too.
class GradientSurvey {
 public:
  /// Values are clamped to [lowest, highest], which takes infinities to the finite ends.
  GradientSurvey(GradientOperator which, const VolumeInfo& info, int firstZ, int lastZ,
                 float lowest, float highest);

  GradientOperator which() const { return which_; }

  /// Slice z, whole in x and y, of the source's type; z runs from max(firstZ - 1, 0) or before to
  /// min(lastZ, dims.z - 1) or beyond.
  void addSlice(int z, std::span<const std::byte> voxels);

  MagnitudeHistogram& histogram() { return histogram_; }
  double largest() const;

 private:
  using Row = const float*;
  std::vector<float>& slice(int z) { return slices_[static_cast<std::size_t>(z % 3)]; }
  void measureSlice(int z);
  /// Row y of slice z, both clamped at the volume.
  Row row(int y, int z);
  /// work(x, x - 1, x + 1) for a row, neighbours clamped at the volume.
  template <typename Work>
  void forNeighbours(Work&& work) const;
  /// Begins a row's differences: those of the neighbours along x.
  void differencesAlongX(Row here);
  /// Adds what a pair of opposite rows says, `direction` (y, z) from one to the other: `straight`
  /// the weight of neighbours at the same x, `oblique` of those beside it.
  void addPair(Row above, Row below, const glm::dvec2& direction, double straight, double oblique);
  void addObliquePairs(Row above, Row below, const glm::dvec2& direction, double oblique);
  void countMagnitudes();

  GradientOperator which_;
  OperatorWeights weights_;
  VoxelType type_;
  glm::ivec3 dims_;
  int firstZ_;
  int lastZ_;
  float lowest_;
  float highest_;
  glm::dmat3 metric_;  ///< |∇f|² = gᵀ·metric·g for differences g across two voxels
  std::array<std::vector<float>, 3> slices_;
  /// One row's, by axis, for loops over a row that fit vector units; NaN where the gradient is not
  /// defined. Its squares are of its magnitudes.
  std::vector<double> alongX_, alongY_, alongZ_, squares_;
  double largestSquare_ = 0;
  MagnitudeHistogram histogram_;
};

}  // namespace burin::node
