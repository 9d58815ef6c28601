#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/node/brick_source.hpp"

namespace burin::node {

/// Throws Error{kVolume} naming both and what differs unless the voxels of a label volume are those
/// of the volume: as many, and none of them further from its own than a hundredth of the smallest
/// spacing, as headers round.
void checkLabelVolume(const VolumeInfo& volume, const VolumeInfo& labels);

/// A set of labels, one bit for all labels that are equal modulo 64: it may hold more than was put
/// in.
using LabelSet = std::uint64_t;
constexpr LabelSet labelSet(int label) {
  return LabelSet{1} << (static_cast<unsigned>(label) & 63u);
}

/// The same on all ranks and for any number of ranks.
struct LabelSurvey {
  std::map<int, std::int64_t> voxels;  ///< by label, of those that occur
  std::vector<LabelSet> blocks;        ///< which occur in each of the blocks of BlockRanges
};

/// Collective. One pass over a label volume, split among the ranks by slabs. Throws
/// CollectiveError, also if a voxel is no label (readLabels in label_voxels.hpp), or if there are
/// more than 2^16 labels.
LabelSurvey surveyLabels(const Communicator& comm, BrickSource& labels);

}  // namespace burin::node
