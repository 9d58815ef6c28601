#include "burin/host/material_profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "voxel_differences.hpp"

namespace burin::host {

namespace {

/// Magnitudes up to the steepest edge of a voxel across a cube's corner (√3 / 2 of the range).
constexpr std::size_t kMagnitudeBins = static_cast<std::size_t>(kGradientSteps);

struct ValueRange {
  double lowest;
  double highest;
};

/// The finite values of `lowest` or `highest` of the blocks, of which a `fraction` is smaller.
float quantile(std::vector<float> values, double fraction) {
  std::erase_if(values, [](float value) { return !std::isfinite(value); });
  if (values.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

ValueRange rangeWithoutOutliers(const node::VolumeSurvey& survey) {
  constexpr double kOutliers = 1e-3;
  constexpr double kStretched = 256;
  const double lowest = double{quantile(survey.blocks.lowest, kOutliers)};
  const double highest = double{quantile(survey.blocks.highest, 1 - kOutliers)};
  const double usual = highest - lowest;
  if (usual > 0 && usual * kStretched < survey.highest - survey.lowest) return {lowest, highest};
  return {survey.lowest, survey.highest};
}

/// Of rows and of slices, such that at most `atMost` voxels are looked at.
int strideFor(glm::ivec3 dims, std::int64_t atMost) {
  const auto voxelsAt = [&](int stride) {
    const auto taken = [&](int count) { return std::int64_t{(count - 1) / stride + 1}; };
    return std::int64_t{dims.x} * taken(dims.y) * taken(dims.z);
  };
  int stride = 1;
  while (stride < std::max(dims.y, dims.z) && voxelsAt(stride) > atMost) ++stride;
  return stride;
}

/// Adds voxels to a profile.
class VoxelProfiler {
 public:
  VoxelProfiler(const VolumeGrid& grid, const ValueRange& range, MaterialProfile& profile)
      : range_{range}, profile_{profile} {
    // Differences across two voxels, over their distance.
    scale_ = 0.5 * kGradientSteps * grid.smallestSpacing() / grid.spacing /
             std::max(range.highest - range.lowest, std::numeric_limits<double>::min());
  }

  void operator()(double value, const glm::dvec3& difference) {
    const double magnitude = glm::length(difference * scale_);
    if (!std::isfinite(magnitude) || !(value >= range_.lowest && value <= range_.highest)) return;
    // Not std::round, a call for each voxel.
    const auto steps =
        static_cast<std::int64_t>(std::min(magnitude + 0.5, double{kMagnitudeBins - 1}));
    const std::size_t bin = profile_.histogram.binOf(value);
    ++profile_.histogram.counts[bin];
    profile_.gradientSums[bin] += steps;
    profile_.squareSums[bin] += steps * steps;
    ++profile_.magnitudeCounts[static_cast<std::size_t>(steps)];
  }

 private:
  ValueRange range_;
  MaterialProfile& profile_;
  glm::dvec3 scale_{1};
};

/// Sums over `radius` bins to either side.
std::int64_t sumAround(const std::vector<std::int64_t>& sums, std::size_t bin, std::size_t radius) {
  const std::size_t first = bin - std::min(bin, radius);
  const std::size_t last = std::min(bin + radius, sums.size() - 1);
  return std::accumulate(sums.begin() + static_cast<std::ptrdiff_t>(first),
                         sums.begin() + static_cast<std::ptrdiff_t>(last) + 1, std::int64_t{0});
}

}  // namespace

double MaterialProfile::steepness(std::size_t bin, std::size_t radius) const {
  const auto area = static_cast<double>(sumAround(gradientSums, bin, radius));
  return area > 0 ? static_cast<double>(sumAround(squareSums, bin, radius)) / area : 0;
}

double MaterialProfile::magnitudeQuantile(double fraction) const {
  const auto total = static_cast<double>(histogram.total());
  std::int64_t seen = 0;
  for (std::size_t i = 0; i < magnitudeCounts.size(); ++i) {
    seen += magnitudeCounts[i];
    if (static_cast<double>(seen) >= fraction * total) return static_cast<double>(i);
  }
  return static_cast<double>(kMagnitudeBins);
}

MaterialProfile profileMaterials(const Communicator& comm, node::BrickSource& source,
                                 const node::VolumeSurvey& survey, std::int64_t atMost) {
  const node::VolumeInfo& info = source.info();
  const ValueRange range = rangeWithoutOutliers(survey);
  MaterialProfile profile;
  profile.histogram = emptyHistogram(info.type, range.lowest, range.highest);
  profile.gradientSums.resize(profile.histogram.counts.size());
  profile.squareSums.resize(profile.histogram.counts.size());
  profile.magnitudeCounts.resize(kMagnitudeBins);

  forVoxelDifferences(comm, source, strideFor(info.grid.dims, atMost),
                      VoxelProfiler{info.grid, range, profile});
  for (auto* sums : {&profile.histogram.counts, &profile.gradientSums, &profile.squareSums,
                     &profile.magnitudeCounts})
    allReduce(comm, std::span{*sums}, MPI_SUM);
  return profile;
}

}  // namespace burin::host
