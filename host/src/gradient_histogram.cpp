#include "burin/host/gradient_histogram.hpp"

#include <algorithm>
#include <cmath>

#include "voxel_differences.hpp"

namespace burin::host {

namespace {

/// Adds voxels to a histogram.
class PairCounter {
 public:
  PairCounter(const VolumeGrid& grid, GradientHistogram& histogram)
      : toWorld_{0.5 * glm::transpose(grid.worldToIndex())}, histogram_{histogram} {}

  void operator()(double value, const glm::dvec3& difference) {
    const double magnitude = glm::length(toWorld_ * difference);
    if (!std::isfinite(value) || !std::isfinite(magnitude)) return;
    const double m = histogram_.scale > 0 ? magnitude / histogram_.scale : 0;
    const auto row = static_cast<std::size_t>(std::min(m * kGradientRows, kGradientRows - 1.0));
    const std::size_t column = histogram_.values.binOf(value);
    ++histogram_.counts[row * histogram_.values.counts.size() + column];
  }

 private:
  glm::dmat3 toWorld_;
  GradientHistogram& histogram_;
};

}  // namespace

GradientHistogram computeGradientHistogram(const Communicator& comm, node::BrickSource& source,
                                           const node::VolumeSurvey& survey) {
  GradientHistogram histogram;
  histogram.values = emptyHistogram(source.info().type, survey.lowest, survey.highest);
  histogram.scale = survey.gradients[GradientOperator::kCentral].percentile;
  std::vector<std::int64_t>& sums = histogram.values.counts;
  histogram.counts.resize(sums.size() * kGradientRows);
  forVoxelDifferences(comm, source, 1, PairCounter{source.info().grid, histogram});
  allReduce(comm, std::span{histogram.counts}, MPI_SUM);
  for (std::size_t i = 0; i < histogram.counts.size(); ++i)
    sums[i % sums.size()] += histogram.counts[i];
  return histogram;
}

}  // namespace burin::host
