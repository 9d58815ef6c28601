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
  std::int64_t total() const;
};

/// At most this many bins.
inline constexpr int kMostBins = 1024;

/// Collective. One pass over all voxels, split among the ranks; the same on all ranks and for any
/// number of them. `survey` is of the same volume. Throws CollectiveError if reading fails.
Histogram computeHistogram(const Communicator& comm, node::BrickSource& source,
                           const node::VolumeSurvey& survey);

/// The value that best parts the histogram in two classes: largest variance between them. The lower
/// edge of the upper class; the histogram's middle if all values lie in one bin.
/// Otsu, "A threshold selection method from gray-level histograms", IEEE SMC 1979.
double otsuThreshold(const Histogram& histogram);

/// Upper edge of the bin up to which `fraction` of all values >= `from` lie.
double quantileAbove(const Histogram& histogram, double from, double fraction);

/// The histogram in block characters, `columns` wide and `rows` high with logarithmic heights, each
/// line ended by a newline, and a line with the ends of the range below.
std::string drawHistogram(const Histogram& histogram, int columns, int rows);

}  // namespace burin::host
