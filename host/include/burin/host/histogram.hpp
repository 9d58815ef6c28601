#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/node/brick_source.hpp"
#include "burin/node/survey.hpp"

namespace burin::host {

/// How often values occur in a volume. Bin i holds the values in [edge(i), edge(i + 1)), the last
/// one its upper edge too. NaN and infinities are left out.
struct Histogram {
  double lowest = 0;    ///< lower edge of the first bin, data units
  double highest = 0;   ///< largest value, at or below the last bin's upper edge
  double binWidth = 1;  ///< a whole number for integer voxels: each bin has as many values
  std::vector<std::int64_t> counts;

  double edge(std::size_t bin) const { return lowest + binWidth * static_cast<double>(bin); }
  /// The bin of a finite value; those beyond the ends count in the end bins.
  std::size_t binOf(double value) const;
  std::int64_t total() const;
};

/// At most this many bins.
inline constexpr int kMostBins = 1024;

/// Bins for values of that type from `lowest` to `highest`, all counts 0.
Histogram emptyHistogram(node::VoxelType type, double lowest, double highest);

/// The z slices that this rank counts, whole in x and y; may be empty.
IndexBox ownSlices(const Communicator& comm, const glm::ivec3& dims);

/// Collective. One pass over all voxels, split among the ranks; the same on all ranks and for any
/// number of them. `survey` is of the same volume. Throws CollectiveError if reading fails.
Histogram computeHistogram(const Communicator& comm, node::BrickSource& source,
                           const node::VolumeSurvey& survey);

/// The value that best parts the histogram in two classes: largest variance between them. The lower
/// edge of the upper class; the middle if all values lie in one bin. Bins below `firstBin` do not
/// count. Otsu, "A threshold selection method from gray-level histograms", IEEE SMC 1979.
double otsuThreshold(const Histogram& histogram, std::size_t firstBin = 0);

/// Upper edge of the bin up to which `fraction` of all values >= `from` lie.
double quantileAbove(const Histogram& histogram, double from, double fraction);

/// The histogram in block characters, `columns` wide and `rows` high with logarithmic heights, each
/// line ended by a newline, and a line with the ends of the range below.
std::string drawHistogram(const Histogram& histogram, int columns, int rows);

}  // namespace burin::host
