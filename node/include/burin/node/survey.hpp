#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/common/geometry.hpp"
#include "burin/common/gradient_operator.hpp"
#include "burin/node/brick_source.hpp"

namespace burin::node {

/// Voxels delivered by readSlabs: the part [box.lo, box.hi) of request number `request`.
struct Slab {
  std::size_t request;
  IndexBox box;                       ///< voxels, spans the request's x and y, some of its z
  std::span<const std::byte> voxels;  ///< native order, x fastest, laid out as `box`
};

/// Collective. Delivers the voxels of each of this rank's boxes in slabs of ascending z, so that no
/// rank ever holds more than `slabBytes` (or one z slice) beside what the callback keeps. A source
/// with random access is read by every rank itself; a stream is read once, by the root, which
/// scatters. A failure anywhere (a read or a callback) ends in CollectiveError on all ranks.
/// Boxes are voxel boxes inside the volume and may be empty or overlap those of other ranks.
void readSlabs(const Communicator& comm, BrickSource& source, std::span<const IndexBox> boxes,
               const std::function<void(const Slab&)>& deliver,
               std::size_t slabBytes = std::size_t{32} << 20);

/// Smallest and largest finite value of each block of blockCells³ cells on the global cell grid,
/// shared faces included (block b covers voxels [b*blockCells, (b+1)*blockCells]). Every rank holds
/// those of the whole volume.
struct BlockRanges {
  int blockCells = 16;
  glm::ivec3 blocks{0};
  std::vector<float> lowest;   ///< +infinity for a block without finite voxels; data units
  std::vector<float> highest;  ///< -infinity likewise
  std::size_t index(const glm::ivec3& block) const;
};

/// Cells along each side of a volume's blocks: 4, 8 or 16, the fewest that make no more than 2^19
/// blocks (or 16). Finer ones tell better where the work is.
int blockCellsFor(const glm::ivec3& dims);

/// Magnitudes |∇f| that count as m = 1: at the voxels, in world units; 0 where the volume has no
/// gradients.
struct GradientScales {
  double percentile = 0;  ///< the 99.9th (relative bin width 2^-10, upper edge)
  double maximum = 0;
};

/// What a survey finds beside the values' ranges.
struct SurveyRequest {
  GradientOperatorSet gradients;
  bool laplacian = false;
  /// Whether nothing of another request is missing.
  bool contains(const SurveyRequest& other) const {
    return gradients.contains(other.gradients) && other.laplacian <= laplacian;
  }
};

/// Facts of the whole volume, the same on all ranks and for any number of ranks.
struct VolumeSurvey {
  double lowest = 0;  ///< of the finite voxels, data units; both 0 if there are none
  double highest = 0;
  std::int64_t nanCount = 0;
  std::int64_t infiniteCount = 0;
  PerGradientOperator<GradientScales> gradients;  ///< of the operators that were asked for
  /// 99.9th percentile of the smoothed Laplacian's magnitude, per squared world unit; 0 if not
  /// asked for.
  double laplacian999 = 0;
  BlockRanges blocks;
};

/// A survey and what it was asked for.
struct KnownSurvey {
  SurveyRequest request;
  VolumeSurvey survey;
};

/// Collective. One pass over all voxels, split among the ranks by slabs. Of gradients and the
/// Laplacian neighbours are clamped at the volume's border, a NaN among those that count skips the
/// voxel, infinities count as the nearest finite end.
VolumeSurvey surveyVolume(const Communicator& comm, BrickSource& source,
                          const SurveyRequest& request);

}  // namespace burin::node
