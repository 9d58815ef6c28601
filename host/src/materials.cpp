#include "materials.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

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
    const bool isCut = first == 0 && above == last();
    if (isCut) above = parting;
    const std::size_t wanted = isCut ? parting : (below + above) / 2;
    return {below, above, steepestBetween(below, above, wanted)};
  }

  /// The boundary of the background of `outer` with the first material in it, if `outer` passes
  /// through that one, or parts it from a second.
  Boundary withoutMaterialBelow(const Boundary& outer) const {
    const std::optional<std::size_t> mode = modeBelow(outer);
    if (!mode) return outer;
    return {outer.below, *mode, steepestBetween(outer.below, *mode, (outer.below + *mode) / 2)};
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

  /// Of the bins about halfway between two that are nearly as steep as the steepest the one nearest
  /// to `wanted`; that one if none there has area.
  std::size_t steepestBetween(std::size_t below, std::size_t above, std::size_t wanted) const {
    constexpr double kNearly = 0.9;
    // Values cut off at the ends of a range are steep, too.
    const std::size_t quarter = (above - below) / 4;
    const auto isSteeperThan = [&](std::size_t bin, double bound) {
      return hasArea(bin) && steepness(bin) > bound;
    };
    double greatest = steepness(wanted);
    for (std::size_t bin = below + quarter; bin + quarter <= above; ++bin)
      if (isSteeperThan(bin, greatest)) greatest = steepness(bin);
    if (steepness(wanted) >= kNearly * greatest) return wanted;
    std::optional<std::size_t> nearest;
    const auto distance = [&](std::size_t bin) {
      return bin > wanted ? bin - wanted : wanted - bin;
    };
    for (std::size_t bin = below + quarter; bin + quarter <= above; ++bin) {
      if (isSteeperThan(bin, kNearly * greatest) &&
          (!nearest || distance(bin) < distance(*nearest)))
        nearest = bin;
    }
    return nearest.value_or(wanted);
  }

  /// The most frequent bin of a material between the background and a boundary: twice as frequent
  /// as values on either side of it, and a good part of what shows. What is much nearer to the
  /// background than to the boundary is another background, such as air beside padding.
  std::optional<std::size_t> modeBelow(const Boundary& outer) const {
    constexpr double kValley = 0.5;
    constexpr double kSmallest = 0.25;
    constexpr double kNearest = 0.4;  // of the way from the background to the boundary
    std::optional<std::size_t> mode;
    std::size_t valley = outer.below;
    std::size_t valleyOfMode = valley;
    const double nearest =
        std::lerp(static_cast<double>(outer.below), static_cast<double>(outer.steepest), kNearest);
    for (std::size_t bin = outer.below; bin <= outer.steepest; ++bin) {
      if (frequency(bin) < frequency(valley)) valley = bin;
      if (static_cast<double>(bin) < nearest) continue;
      if (frequency(valley) < kValley * frequency(bin) &&
          (!mode || frequency(bin) > frequency(*mode))) {
        mode = bin;
        valleyOfMode = valley;
      }
    }
    // A spike of values that stand for nothing is no background of what fills the volume.
    if (!mode || frequency(*mode) > frequency(outer.below)) return std::nullopt;
    std::size_t end = *mode;
    while (end < last() && frequency(end) <= frequency(*mode) &&
           frequency(end) >= kValley * frequency(*mode))
      ++end;
    if (frequency(end) > frequency(*mode)) return std::nullopt;  // on the way up to the second
    const double shown = sumFrom(outer.steepest);
    const double added = sumFrom(valleyOfMode) - shown;
    return added > kSmallest * shown ? mode : std::nullopt;
  }

  /// Voxels in a bin and its neighbours.
  double frequency(std::size_t bin) const {
    constexpr std::size_t kCoarse = 64;  // bins that histograms may be cut to without losing modes
    const std::size_t radius = counts_.size() / kCoarse;
    std::int64_t sum = 0;
    for (std::size_t i = bin - std::min(bin, radius); i <= std::min(bin + radius, last()); ++i)
      sum += counts_[i];
    return static_cast<double>(sum);
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

/// Little lies above it, and it above `base`.
double topAbove(const Histogram& histogram, double base) {
  // One bin at least: a curve needs its points apart, and floats can be told apart no finer.
  return std::max(quantileAbove(histogram, base, 0.99), base + histogram.binWidth);
}

}  // namespace

Materials findMaterials(const MaterialProfile& profile) {
  const Histogram& histogram = profile.histogram;
  const Finder finder{profile};
  Materials found;
  const Boundary outer = finder.withoutMaterialBelow(finder.boundaryFrom(0));
  found.outer = histogram.edge(outer.steepest);
  if (outer.steepest + 2 < histogram.counts.size()) {
    const Boundary inner = finder.boundaryFrom(outer.steepest);
    if (isMaterialWithin(finder, inner, outer.steepest)) {
      found.inner = histogram.edge(inner.steepest);
      found.around = histogram.edge(inner.below);
    }
  }
  found.top = topAbove(histogram, found.inner.value_or(found.outer));
  found.bottom =
      std::min(quantileBelow(histogram, found.outer, 0.01), found.outer - histogram.binWidth);
  const double usual = profile.magnitudeQuantile(0.999);
  found.noise = usual > 0 ? finder.meanMagnitude(outer.below) / usual : 0;
  return found;
}

Materials withFaint(const Materials& materials, double faint, const Histogram& histogram) {
  Materials all = materials;
  all.inner = materials.outer;
  all.outer = faint;
  all.around = faint;
  all.top = topAbove(histogram, *all.inner);
  return all;
}

}  // namespace burin::host
