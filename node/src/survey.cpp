#include "burin/node/survey.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "burin/common/error.hpp"
#include "burin/common/memory_check.hpp"
#include "burin/common/trace.hpp"
#include "gradient_survey.hpp"
#include "laplacian_survey.hpp"
#include "range_survey.hpp"

namespace burin::node {
namespace {

/// The z slices that a rank measures.
struct SliceShare {
  int first;
  int last;  ///< one past
};

SliceShare shareOf(const Communicator& comm, int slices) {
  const auto border = [&](std::int64_t rank) {
    return static_cast<int>(slices * rank / comm.size());
  };
  const auto rank = static_cast<std::int64_t>(comm.rank());
  return {border(rank), border(rank + 1)};
}

/// Collective. Calls work(z, slice) for each of this rank's slices in ascending order, and for the
/// `neighbours` slices next to them on either side, as far as there are any.
template <typename Work>
void forSlices(const Communicator& comm, BrickSource& source, const SliceShare& share,
               int neighbours, Work&& work) {
  const glm::ivec3 dims = source.info().grid.dims;
  IndexBox mine{{0, 0, share.first}, {dims.x, dims.y, share.last}};
  if (!mine.empty()) {
    mine.lo.z = std::max(mine.lo.z - neighbours, 0);
    mine.hi.z = std::min(mine.hi.z + neighbours, dims.z);
  }
  readSlabs(comm, source, std::span{&mine, 1}, [&](const Slab& slab) {
    const std::size_t sliceBytes = slab.voxels.size() / static_cast<std::size_t>(slab.box.size().z);
    for (int z = slab.box.lo.z; z < slab.box.hi.z; ++z) {
      const auto index = static_cast<std::size_t>(z - slab.box.lo.z);
      work(z, slab.voxels.subspan(index * sliceBytes).first(sliceBytes));
    }
  });
}

/// Minima of `lowest` and maxima of `highest` over the ranks.
void mergeBlocks(const Communicator& comm, BlockRanges& blocks) {
  std::vector<double> extremes(blocks.lowest.begin(), blocks.lowest.end());
  for (const float highest : blocks.highest) extremes.push_back(-double{highest});
  allReduce(comm, std::span{extremes}, MPI_MIN);
  const std::size_t count = blocks.lowest.size();
  for (std::size_t i = 0; i < count; ++i) {
    blocks.lowest[i] = static_cast<float>(extremes[i]);
    blocks.highest[i] = static_cast<float>(-extremes[count + i]);
  }
}

void mergeRanges(const Communicator& comm, VolumeSurvey& survey) {
  mergeBlocks(comm, survey.blocks);
  std::int64_t counts[2] = {survey.nanCount, survey.infiniteCount};
  allReduce(comm, std::span<std::int64_t>{counts}, MPI_SUM);
  survey.nanCount = counts[0];
  survey.infiniteCount = counts[1];
  // Blocks cover all voxels and floats hold all four types exactly, so their extremes are the
  // volume's.
  const float lowest = *std::ranges::min_element(survey.blocks.lowest);
  const float highest = *std::ranges::max_element(survey.blocks.highest);
  if (lowest > highest) return;  // nothing finite
  survey.lowest = double{lowest};
  survey.highest = double{highest};
}

/// What is asked for of derivatives, of this rank's slices.
class DerivativeSurveys {
 public:
  DerivativeSurveys() = default;
  DerivativeSurveys(const SurveyRequest& request, const VolumeInfo& info, const SliceShare& share,
                    float lowest, float highest) {
    for (const GradientOperator which : kAllGradientOperators)
      if (request.gradients.contains(which))
        gradients_.emplace_back(which, info, share.first, share.last, lowest, highest);
    if (request.laplacian) laplacian_.emplace(info, share.first, share.last, lowest, highest);
  }

  /// Slices beyond this rank's own that they look at.
  int reach() const { return laplacian_ ? kLaplacianReach : gradients_.empty() ? 0 : 1; }

  void addSlice(int z, std::span<const std::byte> voxels) {
    for (GradientSurvey& gradients : gradients_) gradients.addSlice(z, voxels);
    if (laplacian_) laplacian_->addSlice(voxels);
  }

  /// Collective.
  void merge(const Communicator& comm, VolumeSurvey& survey) {
    for (GradientSurvey& gradients : gradients_) {
      GradientScales& scales = survey.gradients[gradients.which()];
      scales.maximum = gradients.largest();
      allReduce(comm, std::span{&scales.maximum, 1}, MPI_MAX);
      scales.percentile = percentile999(comm, gradients.histogram());
    }
    if (laplacian_)
      survey.laplacian999 = laplacian_->unit() * percentile999(comm, laplacian_->histogram());
  }

 private:
  static double percentile999(const Communicator& comm, MagnitudeHistogram& histogram) {
    allReduce(comm, histogram.counts(), MPI_SUM);
    return histogram.percentile(0.999);
  }

  std::vector<GradientSurvey> gradients_;
  std::optional<LaplacianSurvey> laplacian_;
};

/// What is sure to be needed: the ranges of all blocks, and a slice of voxels.
MemoryNeed needOf(const VolumeInfo& info) {
  const glm::ivec3& dims = info.grid.dims;
  const int cells = blockCellsFor(dims);
  const std::size_t blocks =
      IndexBox{glm::ivec3{0}, (info.grid.cells() + cells - 1) / cells}.count();
  const std::size_t slice = IndexBox{glm::ivec3{0}, {dims.x, dims.y, 1}}.count();
  const std::size_t bytes = 2 * sizeof(float) * blocks + bytesPerVoxel(info.type) * slice;
  return {static_cast<std::int64_t>(bytes),
          fmt::format("the survey of {} ({} x {} x {} voxels)", info.name, dims.x, dims.y, dims.z)};
}

}  // namespace

VolumeSurvey surveyVolume(const Communicator& comm, BrickSource& source,
                          const SurveyRequest& request) {
  const TraceSpan span{"survey"};
  const VolumeInfo& info = source.info();
  const SliceShare share = shareOf(comm, info.grid.dims.z);
  constexpr float kLargest = std::numeric_limits<float>::max();
  std::unique_ptr<RangeSurvey> ranges;
  DerivativeSurveys derivatives;
  // Room for slices and blocks, of which a large volume needs much.
  checkMemory(comm, needOf(info));
  collectively(comm, "making room for the survey", [&] {
    ranges = makeRangeSurvey(info);
    derivatives = {request, info, share, -kLargest, kLargest};
  });
  forSlices(comm, source, share, derivatives.reach(),
            [&](int z, std::span<const std::byte> voxels) {
              if (z >= share.first && z < share.last) ranges->addSlice(z, voxels);
              derivatives.addSlice(z, voxels);
            });
  VolumeSurvey survey;
  ranges->finish(survey);
  mergeRanges(comm, survey);
  if (derivatives.reach() == 0) return survey;
  if (survey.infiniteCount > 0) {
    // Only now is it known where infinities are clamped to: the gradients once more.
    collectively(comm, "making room for the survey", [&] {
      derivatives = {request, info, share, static_cast<float>(survey.lowest),
                     static_cast<float>(survey.highest)};
    });
    forSlices(comm, source, share, derivatives.reach(),
              [&](int z, std::span<const std::byte> voxels) { derivatives.addSlice(z, voxels); });
  }
  derivatives.merge(comm, survey);
  return survey;
}

}  // namespace burin::node
