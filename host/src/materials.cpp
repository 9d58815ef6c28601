#include "materials.hpp"

#include <algorithm>
#include <numeric>

namespace burin::host {

namespace {

/// Lower edge of the bin from which on all but `fraction` of the values < `end` lie.
double quantileBelow(const Histogram& histogram, double end, double fraction) {
  std::int64_t all = 0;
  std::size_t bins = 0;
  while (bins < histogram.counts.size() && histogram.edge(bins) < end)
    all += histogram.counts[bins++];
  std::int64_t seen = 0;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    seen += histogram.counts[bin];
    if (static_cast<double>(seen) > fraction * static_cast<double>(all)) return histogram.edge(bin);
  }
  return histogram.lowest;
}

/// Bins to either side that smooth counts and gradients, for so many bins.
std::size_t smoothing(std::size_t bins) {
  constexpr std::size_t kSmoothed = 128;
  return bins / kSmoothed;
}

/// Two classes of values and the bin where the field between them is steepest.
struct Boundary {
  std::size_t below;  ///< most frequent bins of the classes
  std::size_t above;
  std::size_t steepest;
};

class Finder {
 public:
  explicit Finder(const MaterialProfile& profile)
      : profile_{profile},
        counts_{profile.histogram.counts},
        radius_{smoothing(profile.histogram.counts.size())} {}

  /// The boundary in the bins from `first` on.
  Boundary boundaryFrom(std::size_t first) const {
    const std::size_t parting = profile_.histogram.binOf(centreAt(otsu(first)));
    const std::size_t below = mostFrequent(first, std::max(parting, first + 1));
    std::size_t above = mostFrequent(std::max(parting, first + 1), counts_.size());
    // Values cut off at the end of the range are no material that background could border on.
    if (first == 0 && above == last()) above = parting;
    std::size_t steepest = parting;
    // About halfway: values cut off at the ends of a range are steep, too.
    const std::size_t quarter = (above - below) / 4;
    for (std::size_t bin = below + quarter; bin + quarter <= above; ++bin) {
      if (hasArea(bin) && steepness(bin) > steepness(steepest)) steepest = bin;
    }
    return {below, above, steepest};
  }

  double steepness(std::size_t bin) const { return profile_.steepness(bin, radius_); }

  /// Share of the voxels from bin `first` on that are in bin `from` or above.
  double shareAbove(std::size_t from, std::size_t first) const {
    const double all = sumFrom(first);
    return all > 0 ? sumFrom(from) / all : 0;
  }

  double meanMagnitude(std::size_t bin) const {
    double count = 0, sum = 0;
    for (std::size_t i = bin - std::min(bin, radius_); i <= std::min(bin + radius_, last()); ++i) {
      count += static_cast<double>(counts_[i]);
      sum += static_cast<double>(profile_.gradientSums[i]);
    }
    return count > 0 ? sum / count : 0;
  }

 private:
  std::size_t last() const { return counts_.size() - 1; }
  double otsu(std::size_t first) const { return otsuThreshold(profile_.histogram, first); }
  /// Within the bin whose lower edge this is, whatever that rounds to.
  double centreAt(double edge) const { return edge + profile_.histogram.binWidth / 2; }

  double sumFrom(std::size_t bin) const {
    return static_cast<double>(std::accumulate(counts_.begin() + static_cast<std::ptrdiff_t>(bin),
                                               counts_.end(), std::int64_t{0}));
  }

  /// In [first, end), which may be empty beyond the last bin.
  std::size_t mostFrequent(std::size_t first, std::size_t end) const {
    std::size_t best = std::min(first, last());
    for (std::size_t bin = first; bin < std::min(end, counts_.size()); ++bin) {
      if (counts_[bin] > counts_[best]) best = bin;
    }
    return best;
  }

  /// Whether a bin's iso-surface is large enough for its mean to mean something.
  bool hasArea(std::size_t bin) const {
    constexpr double kSmallestShare = 1e-4;
    const double all = static_cast<double>(std::accumulate(
        profile_.gradientSums.begin(), profile_.gradientSums.end(), std::int64_t{0}));
    return static_cast<double>(profile_.gradientSums[bin]) > kSmallestShare * all;
  }

  const MaterialProfile& profile_;
  const std::vector<std::int64_t>& counts_;
  std::size_t radius_;
};

/// Whether what a boundary parts is worth showing by itself: a small part of the whole, behind a
/// boundary that is steeper than the inside of the material around.
bool isMaterialWithin(const Finder& finder, const Boundary& boundary, std::size_t outer) {
  constexpr double kSmallest = 0.003;
  constexpr double kLargest = 0.5;
  constexpr double kSteeper = 1.25;
  const double share = finder.shareAbove(boundary.steepest, outer);
  return boundary.steepest > outer && share > kSmallest && share < kLargest &&
         finder.steepness(boundary.steepest) > kSteeper * finder.steepness(boundary.below);
}

}  // namespace

Materials findMaterials(const MaterialProfile& profile) {
  const Histogram& histogram = profile.histogram;
  const Finder finder{profile};
  Materials found;
  const Boundary outer = finder.boundaryFrom(0);
  found.outer = histogram.edge(outer.steepest);
  if (outer.steepest + 2 < histogram.counts.size()) {
    const Boundary inner = finder.boundaryFrom(outer.steepest);
    if (isMaterialWithin(finder, inner, outer.steepest)) {
      found.inner = histogram.edge(inner.steepest);
      found.around = histogram.edge(inner.below);
    }
  }
  const double base = found.inner.value_or(found.outer);
  // One bin at least: a curve needs its points apart, and floats can be told apart no finer.
  found.top = std::max(quantileAbove(histogram, base, 0.99), base + histogram.binWidth);
  found.bottom =
      std::min(quantileBelow(histogram, found.outer, 0.01), found.outer - histogram.binWidth);
  const double usual = profile.magnitudeQuantile(0.999);
  found.noise = usual > 0 ? finder.meanMagnitude(outer.below) / usual : 0;
  return found;
}

}  // namespace burin::host
