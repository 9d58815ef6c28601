#pragma once

#include <cstdint>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/host/histogram.hpp"
#include "burin/host/picture.hpp"
#include "burin/node/brick_source.hpp"
#include "burin/node/survey.hpp"

namespace burin::host {

/// How often values and gradient magnitudes occur together: in it, materials are blobs at the
/// bottom and boundaries between two of them arches (Kindlmann & Durkin 1998), on which the widgets
/// of two-dimensional transfer functions are laid.
struct GradientHistogram {
  Histogram values;  ///< the columns; its counts are over all magnitudes
  double scale = 0;  ///< |∇f| per world unit that is m = 1; 0: no gradients
  /// By row and column; row r holds m in [r, r + 1) / kGradientRows, the last one all above too.
  std::vector<std::int64_t> counts;

  std::int64_t at(int row, std::size_t column) const {
    return counts[static_cast<std::size_t>(row) * values.counts.size() + column];
  }
};

inline constexpr int kGradientRows = 128;

/// Collective. One pass over all voxels, split among the ranks; the same on all ranks and for any
/// number of them. Gradients are central differences; voxels next to such as are not finite do not
/// count. `survey` is of the same volume, with those gradients. Throws CollectiveError if reading
/// fails.
GradientHistogram computeGradientHistogram(const Communicator& comm, node::BrickSource& source,
                                           const node::VolumeSurvey& survey);

/// As a picture (3 channels): logarithmic shades of grey, values to the right in data units, m
/// upwards. Throws Error{kUsage} if there is no font.
DisplayPicture drawGradientHistogram(const GradientHistogram& histogram);

}  // namespace burin::host
