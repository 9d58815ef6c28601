#include "burin/node/survey.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "burin/common/error.hpp"
#include "gradient_survey.hpp"
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
/// slices next to them if they have neighbours.
template <typename Work>
void forSlices(const Communicator& comm, BrickSource& source, const SliceShare& share,
               bool withNeighbours, Work&& work) {
  const glm::ivec3 dims = source.info().grid.dims;
  IndexBox mine{{0, 0, share.first}, {dims.x, dims.y, share.last}};
  if (withNeighbours && !mine.empty()) {
    mine.lo.z = std::max(mine.lo.z - 1, 0);
    mine.hi.z = std::min(mine.hi.z + 1, dims.z);
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

void mergeGradients(const Communicator& comm, GradientSurvey& gradients, VolumeSurvey& survey) {
  double largest = gradients.largest();
  allReduce(comm, std::span{&largest, 1}, MPI_MAX);
  allReduce(comm, gradients.histogram().counts(), MPI_SUM);
  survey.largestGradient = largest;
  survey.gradient999 = gradients.histogram().percentile(0.999);
}

}  // namespace

VolumeSurvey surveyVolume(const Communicator& comm, BrickSource& source, bool withGradients) {
  const VolumeInfo& info = source.info();
  const SliceShare share = shareOf(comm, info.grid.dims.z);
  constexpr float kLargest = std::numeric_limits<float>::max();
  std::unique_ptr<RangeSurvey> ranges;
  std::optional<GradientSurvey> gradients;
  // Room for slices and blocks, of which a large volume needs much.
  collectively(comm, "making room for the survey", [&] {
    ranges = makeRangeSurvey(info);
    if (withGradients) gradients.emplace(info, share.first, share.last, -kLargest, kLargest);
  });
  forSlices(comm, source, share, withGradients, [&](int z, std::span<const std::byte> voxels) {
    if (z >= share.first && z < share.last) ranges->addSlice(z, voxels);
    if (gradients) gradients->addSlice(z, voxels);
  });
  VolumeSurvey survey;
  ranges->finish(survey);
  mergeRanges(comm, survey);
  if (!withGradients) return survey;
  if (survey.infiniteCount > 0) {
    // Only now is it known where infinities are clamped to: the gradients once more.
    collectively(comm, "making room for the survey", [&] {
      gradients.emplace(info, share.first, share.last, static_cast<float>(survey.lowest),
                        static_cast<float>(survey.highest));
    });
    forSlices(comm, source, share, true,
              [&](int z, std::span<const std::byte> voxels) { gradients->addSlice(z, voxels); });
  }
  mergeGradients(comm, *gradients, survey);
  return survey;
}

}  // namespace burin::node
