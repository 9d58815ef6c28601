#pragma once

#include "gradient_survey.hpp"
#include "smoothed_laplacian.hpp"

namespace burin::node {

/// Magnitudes of the smoothed Laplacian of z slices that come in ascending order: those of the
/// slices [firstZ, lastZ), kLaplacianReach more to either side coming too where there are any.
class LaplacianSurvey {
 public:
  /// Values are clamped to [lowest, highest], which takes infinities to the finite ends.
  LaplacianSurvey(const VolumeInfo& info, int firstZ, int lastZ, float lowest, float highest);

  /// A slice, whole in x and y, of the source's type.
  void addSlice(std::span<const std::byte> voxels);

  /// In units of `unit()`.
  MagnitudeHistogram& histogram() { return histogram_; }
  double unit() const { return filter_.unit(); }

 private:
  VoxelType type_;
  int begin_;  ///< first slice that comes
  int firstZ_;
  int lastZ_;
  float lowest_;
  float highest_;
  SmoothedLaplacian filter_;
  std::vector<float> values_;
  MagnitudeHistogram histogram_;
};

}  // namespace burin::node
