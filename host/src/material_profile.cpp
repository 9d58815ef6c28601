#include "burin/host/material_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

namespace burin::host {

namespace {

using node::VoxelType;

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

template <typename Voxel>
void widen(std::span<const std::byte> bytes, std::vector<float>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    Voxel voxel;
    std::memcpy(&voxel, bytes.data() + i * sizeof(Voxel), sizeof(Voxel));
    values[i] = static_cast<float>(voxel);
  }
}

void widen(VoxelType type, std::span<const std::byte> bytes, std::vector<float>& values) {
  switch (type) {
    case VoxelType::kU8:
      return widen<std::uint8_t>(bytes, values);
    case VoxelType::kI16:
      return widen<std::int16_t>(bytes, values);
    case VoxelType::kU16:
      return widen<std::uint16_t>(bytes, values);
    case VoxelType::kF32:
      return widen<float>(bytes, values);
  }
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

/// Adds slices, which come in ascending order with their neighbours, to a profile.
class SliceProfiler {
 public:
  SliceProfiler(const node::VolumeInfo& info, const ValueRange& range, int stride,
                MaterialProfile& profile)
      : type_{info.type}, dims_{info.grid.dims}, range_{range}, stride_{stride}, profile_{profile} {
    // Differences across two voxels, over their distance.
    scale_ = 0.5 * kGradientSteps * info.grid.smallestSpacing() / info.grid.spacing /
             std::max(range.highest - range.lowest, std::numeric_limits<double>::min());
    for (auto& slice : slices_)
      slice.resize(static_cast<std::size_t>(dims_.x) * static_cast<std::size_t>(dims_.y));
  }

  void load(int z, std::span<const std::byte> voxels) { widen(type_, voxels, slice(z)); }

  /// The slices next to z have been loaded.
  void add(int z) {
    if (z % stride_ != 0) return;
    const std::vector<float>& here = slice(z);
    const std::vector<float>& below = slice(std::max(z - 1, 0));
    const std::vector<float>& above = slice(std::min(z + 1, dims_.z - 1));
    for (int y = 0; y < dims_.y; y += stride_) {
      for (int x = 0; x < dims_.x; ++x) {
        const std::size_t at = offset(x, y);
        const glm::dvec3 difference{double{here[offset(std::min(x + 1, dims_.x - 1), y)]} -
                                        double{here[offset(std::max(x - 1, 0), y)]},
                                    double{here[offset(x, std::min(y + 1, dims_.y - 1))]} -
                                        double{here[offset(x, std::max(y - 1, 0))]},
                                    double{above[at]} - double{below[at]}};
        count(double{here[at]}, glm::length(difference * scale_));
      }
    }
  }

 private:
  std::vector<float>& slice(int z) { return slices_[static_cast<std::size_t>(z % 3)]; }
  std::size_t offset(int x, int y) const {
    return static_cast<std::size_t>(x) +
           static_cast<std::size_t>(y) * static_cast<std::size_t>(dims_.x);
  }

  void count(double value, double magnitude) {
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

  VoxelType type_;
  glm::ivec3 dims_;
  ValueRange range_;
  int stride_;
  MaterialProfile& profile_;
  glm::dvec3 scale_{1};
  std::array<std::vector<float>, 3> slices_;
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
  const glm::ivec3 dims = info.grid.dims;
  const ValueRange range = rangeWithoutOutliers(survey);
  MaterialProfile profile;
  profile.histogram = emptyHistogram(info.type, range.lowest, range.highest);
  profile.gradientSums.resize(profile.histogram.counts.size());
  profile.squareSums.resize(profile.histogram.counts.size());
  profile.magnitudeCounts.resize(kMagnitudeBins);

  const IndexBox mine = ownSlices(comm, dims);
  IndexBox withNeighbours = mine;
  if (!mine.empty()) {
    withNeighbours.lo.z = std::max(mine.lo.z - 1, 0);
    withNeighbours.hi.z = std::min(mine.hi.z + 1, dims.z);
  }
  SliceProfiler slices{info, range, strideFor(dims, atMost), profile};
  node::readSlabs(comm, source, std::span{&withNeighbours, 1}, [&](const node::Slab& slab) {
    const std::size_t bytes = slab.voxels.size() / static_cast<std::size_t>(slab.box.size().z);
    for (int z = slab.box.lo.z; z < slab.box.hi.z; ++z) {
      slices.load(z, slab.voxels.subspan(bytes * static_cast<std::size_t>(z - slab.box.lo.z)));
      if (z - 1 >= mine.lo.z && z - 1 < mine.hi.z) slices.add(z - 1);
      if (z == dims.z - 1 && z < mine.hi.z) slices.add(z);
    }
  });
  for (auto* sums : {&profile.histogram.counts, &profile.gradientSums, &profile.squareSums,
                     &profile.magnitudeCounts})
    allReduce(comm, std::span{*sums}, MPI_SUM);
  return profile;
}

}  // namespace burin::host
