#include "burin/host/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace burin::host {

namespace {

using node::VoxelType;

template <typename Voxel>
void countVoxels(std::span<const std::byte> bytes, Histogram& histogram) {
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(Voxel)) {
    Voxel voxel;
    std::memcpy(&voxel, bytes.data() + at, sizeof(Voxel));
    const auto value = static_cast<double>(voxel);
    if (std::isfinite(value)) ++histogram.counts[histogram.binOf(value)];
  }
}

void countSlab(VoxelType type, std::span<const std::byte> bytes, Histogram& histogram) {
  switch (type) {
    case VoxelType::kU8:
      return countVoxels<std::uint8_t>(bytes, histogram);
    case VoxelType::kI16:
      return countVoxels<std::int16_t>(bytes, histogram);
    case VoxelType::kU16:
      return countVoxels<std::uint16_t>(bytes, histogram);
    case VoxelType::kF32:
      return countVoxels<float>(bytes, histogram);
  }
}

}  // namespace

std::size_t Histogram::binOf(double value) const {
  const auto lastBin = static_cast<double>(counts.size() - 1);
  return static_cast<std::size_t>(std::clamp((value - lowest) / binWidth, 0.0, lastBin));
}

std::int64_t Histogram::total() const {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

Histogram emptyHistogram(VoxelType type, double lowest, double highest) {
  Histogram histogram;
  histogram.lowest = lowest;
  histogram.highest = highest;
  const double range = highest - lowest;
  if (type == VoxelType::kF32) {
    const bool isConstant = !(range / kMostBins > 0);
    histogram.binWidth = isConstant ? 1.0 : range / kMostBins;
    histogram.counts.resize(isConstant ? 1 : kMostBins);
  } else {
    histogram.binWidth = std::max(1.0, std::ceil((range + 1) / kMostBins));
    histogram.counts.resize(static_cast<std::size_t>(std::ceil((range + 1) / histogram.binWidth)));
  }
  return histogram;
}

IndexBox ownSlices(const Communicator& comm, const glm::ivec3& dims) {
  const auto boundary = [&](std::int64_t rank) {
    return static_cast<int>(dims.z * rank / comm.size());
  };
  const auto rank = static_cast<std::int64_t>(comm.rank());
  return {{0, 0, boundary(rank)}, {dims.x, dims.y, boundary(rank + 1)}};
}

Histogram computeHistogram(const Communicator& comm, node::BrickSource& source,
                           const node::VolumeSurvey& survey) {
  const VoxelType type = source.info().type;
  Histogram histogram = emptyHistogram(type, survey.lowest, survey.highest);
  const IndexBox mine = ownSlices(comm, source.info().grid.dims);
  node::readSlabs(comm, source, std::span{&mine, 1},
                  [&](const node::Slab& slab) { countSlab(type, slab.voxels, histogram); });
  allReduce(comm, std::span{histogram.counts}, MPI_SUM);
  return histogram;
}

double otsuThreshold(const Histogram& histogram, std::size_t firstBin) {
  const std::span counts = std::span{histogram.counts}.subspan(firstBin);
  double total = 0;
  double weightedSum = 0;  // bin numbers do instead of values: the threshold is the same
  for (std::size_t i = 0; i < counts.size(); ++i) {
    total += static_cast<double>(counts[i]);
    weightedSum += static_cast<double>(i) * static_cast<double>(counts[i]);
  }
  double below = 0;
  double belowSum = 0;
  double best = -1;
  std::size_t bestBin = counts.size() / 2;
  for (std::size_t i = 1; i < counts.size(); ++i) {  // classes [0, i) and [i, end)
    below += static_cast<double>(counts[i - 1]);
    belowSum += static_cast<double>(i - 1) * static_cast<double>(counts[i - 1]);
    const double above = total - below;
    if (below <= 0 || above <= 0) continue;
    const double distance = belowSum / below - (weightedSum - belowSum) / above;
    const double between = below * above * distance * distance;
    if (between > best) {
      best = between;
      bestBin = i;
    }
  }
  return histogram.edge(firstBin + bestBin);
}

double quantileAbove(const Histogram& histogram, double from, double fraction) {
  const auto& counts = histogram.counts;
  std::size_t first = 0;
  while (first < counts.size() && histogram.edge(first) < from) ++first;
  std::int64_t above = 0;
  for (std::size_t i = first; i < counts.size(); ++i) above += counts[i];
  std::int64_t seen = 0;
  for (std::size_t i = first; i < counts.size(); ++i) {
    seen += counts[i];
    if (static_cast<double>(seen) >= fraction * static_cast<double>(above))
      return histogram.edge(i + 1);
  }
  return histogram.edge(counts.size());
}

}  // namespace burin::host
