#pragma once

#include <cstdint>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/host/histogram.hpp"
#include "burin/node/brick_source.hpp"
#include "burin/node/survey.hpp"

namespace burin::host {

/// How often values occur in a volume, and how fast the field changes where they do: what tells
/// materials (many voxels, small gradients) from the boundaries between them.
struct MaterialProfile {
  Histogram histogram;
  /// Sums of |∇f| and of |∇f|² over the voxels of each bin. Whole numbers of kGradientSteps to the
  /// histogram's range per smallest spacing, so that they add up alike on any number of ranks.
  std::vector<std::int64_t> gradientSums;
  std::vector<std::int64_t> squareSums;
  /// How often each |∇f| occurs in the volume, in the same unit; larger ones in the last entry.
  std::vector<std::int64_t> magnitudeCounts;

  /// Mean of |∇f| over the iso-surfaces of a bin and those within `radius` bins: Σ|∇f|² / Σ|∇f|, as
  /// voxels of a value are as many as its iso-surface has area per |∇f|. 0 where nothing changes.
  /// Pekar, Wiemker & Hempel, "Fast detection of meaningful isosurfaces", IEEE Visualization 2001.
  double steepness(std::size_t bin, std::size_t radius) const;
  /// The magnitude that `fraction` of all voxels do not exceed.
  double magnitudeQuantile(double fraction) const;
};

inline constexpr double kGradientSteps = 4096;

/// About how many voxels tell what a volume is made of.
inline constexpr std::int64_t kProfiledVoxels = std::int64_t{1} << 24;

/// Collective. One pass over the volume, split among the ranks; the same on all ranks and for any
/// number of them. Of a volume of more than `atMost` voxels it looks at each n-th row of each n-th
/// slice, n as small as that allows; differences are those to the next voxels all the same. A few
/// voxels far beyond all others do not stretch the bins: these span what all but a thousandth of
/// the survey's blocks hold, if that is less than a 256th of the whole range. `survey` is of the
/// same volume. Throws CollectiveError if reading fails.
MaterialProfile profileMaterials(const Communicator& comm, node::BrickSource& source,
                                 const node::VolumeSurvey& survey,
                                 std::int64_t atMost = kProfiledVoxels);

}  // namespace burin::host
