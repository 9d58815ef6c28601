#include "material_layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "burin/host/histogram.hpp"

namespace burin::host {

namespace {

/// Mean over blocks of the share of them that is high: 0, a half if both occur, or 1.
struct HighShare {
  double sum = 0;
  double blocks = 0;
  double mean() const { return blocks > 0 ? sum / blocks : 0; }
};

template <typename Visit>
void forBlocks(const node::BlockRanges& blocks, Visit&& visit) {
  for (int z = 0; z < blocks.blocks.z; ++z)
    for (int y = 0; y < blocks.blocks.y; ++y)
      for (int x = 0; x < blocks.blocks.x; ++x) visit(glm::ivec3{x, y, z});
}

/// How often highest values of blocks occur below `boundary`.
Histogram highestBelow(const node::BlockRanges& blocks, double boundary) {
  constexpr std::size_t kBins = 64;
  double lowest = boundary;
  for (const float value : blocks.lowest)
    if (std::isfinite(value)) lowest = std::min(lowest, double{value});
  Histogram histogram;
  histogram.lowest = lowest;
  histogram.highest = boundary;
  histogram.binWidth = std::max((boundary - lowest) / kBins, std::numeric_limits<double>::min());
  histogram.counts.resize(kBins);
  for (const float value : blocks.highest)
    if (std::isfinite(value) && double{value} < boundary)
      ++histogram.counts[histogram.binOf(double{value})];
  return histogram;
}

/// The bins [first, end) of a histogram.
struct BinGroup {
  std::size_t first;
  std::size_t end;
};

/// Counts around the bin of a group where they are highest.
struct Peak {
  std::size_t bin;
  std::int64_t count;
};

/// Counts of a bin and its neighbours, of those in a group.
std::int64_t countAround(const Histogram& histogram, std::size_t bin, const BinGroup& group) {
  constexpr std::size_t kRadius = 2;
  std::int64_t sum = 0;
  const std::size_t first = std::max(bin - std::min(bin, kRadius), group.first);
  for (std::size_t i = first; i < std::min(bin + kRadius + 1, group.end); ++i)
    sum += histogram.counts[i];
  return sum;
}

Peak peakOf(const Histogram& histogram, const BinGroup& group) {
  Peak peak{group.first, 0};
  for (std::size_t bin = group.first; bin < group.end; ++bin) {
    const std::int64_t count = countAround(histogram, bin, group);
    if (count > peak.count) peak = {bin, count};
  }
  return peak;
}

/// Whether few lie between the peaks of the groups below and above a bin.
bool isGap(const Histogram& histogram, std::size_t parting) {
  constexpr double kValley = 0.5;
  const BinGroup all{0, histogram.counts.size()};
  const Peak low = peakOf(histogram, {0, parting});
  const Peak high = peakOf(histogram, {parting, all.end});
  std::int64_t least = low.count;
  for (std::size_t bin = low.bin; bin <= high.bin; ++bin)
    least = std::min(least, countAround(histogram, bin, all));
  return static_cast<double>(least) <
         kValley * static_cast<double>(std::min(low.count, high.count));
}

/// Share of the variance that a bin's parting explains: 0.75 of even counts, 0.65 of noise whose
/// counts fall by a constant factor from bin to bin.
double explainedBy(const Histogram& histogram, std::size_t parting) {
  glm::dvec3 all{0}, above{0};  // count, sum, sum of squares of the bins
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
    const auto at = static_cast<double>(bin);
    const glm::dvec3 moments =
        static_cast<double>(histogram.counts[bin]) * glm::dvec3{1, at, at * at};
    all += moments;
    if (bin >= parting) above += moments;
  }
  const double below = all[0] - above[0];
  if (!(above[0] > 0 && below > 0)) return 0;
  const double total = all[2] - all[1] * all[1] / all[0];  // above 0: two bins differ
  const double distance = above[1] / above[0] - (all[1] - above[1]) / below;
  return below * above[0] / all[0] * distance * distance / total;
}

/// How two groups of values are parted.
struct Parting {
  double value;
  bool isGap;        ///< few lie between them
  double explained;  ///< explainedBy()
};

/// Nothing if there are not two groups.
std::optional<Parting> partingOf(const Histogram& histogram) {
  const double edge = otsuThreshold(histogram);
  const auto bin =
      static_cast<std::size_t>(std::lround((edge - histogram.lowest) / histogram.binWidth));
  const double explained = explainedBy(histogram, bin);
  if (!(explained > 0)) return std::nullopt;
  std::size_t next = bin;  // where the upper group begins
  while (histogram.counts[next] == 0) ++next;
  return Parting{0.5 * (edge + histogram.edge(next)), isGap(histogram, bin), explained};
}

/// Whether a block or one next to it, also across an edge or a corner, reaches a value.
bool isNear(const node::BlockRanges& blocks, const glm::ivec3& block, double value) {
  const glm::ivec3 lo = glm::max(block - 1, 0);
  const glm::ivec3 hi = glm::min(block + 1, blocks.blocks - 1);
  for (int z = lo.z; z <= hi.z; ++z)
    for (int y = lo.y; y <= hi.y; ++y)
      for (int x = lo.x; x <= hi.x; ++x)
        if (double{blocks.highest[blocks.index({x, y, z})]} >= value) return true;
  return false;
}

}  // namespace

Surroundings findSurroundings(const node::BlockRanges& blocks, double boundary) {
  constexpr double kThinnest = 0.1;    // of all blocks, those that lie within
  constexpr double kAsFrequent = 0.9;  // at the faces, of within
  constexpr double kRare = 0.3;
  HighShare faces, within;
  forBlocks(blocks, [&](const glm::ivec3& block) {
    const std::size_t at = blocks.index(block);
    const double lowest = double{blocks.lowest[at]};
    const double highest = double{blocks.highest[at]};
    if (lowest > highest) return;  // nothing finite
    const bool isFace = glm::any(glm::equal(block, glm::ivec3{0})) ||
                        glm::any(glm::equal(block, blocks.blocks - 1));
    HighShare& share = isFace ? faces : within;
    share.sum += 0.5 * ((lowest >= boundary ? 1 : 0) + (highest >= boundary ? 1 : 0));
    share.blocks += 1;
  });
  if (within.blocks < kThinnest * (faces.blocks + within.blocks)) return Surroundings::kDark;
  const double lowAtFaces = 1 - faces.mean();
  const double lowWithin = 1 - within.mean();
  if (faces.mean() > 0.5 && lowAtFaces < kRare * lowWithin) return Surroundings::kBright;
  if (within.mean() > 0 && faces.mean() > kAsFrequent * within.mean()) return Surroundings::kNone;
  return Surroundings::kDark;
}

double bareShare(const node::BlockRanges& blocks, double outer, double inner) {
  double boundary = 0, bare = 0;
  for (std::size_t i = 0; i < blocks.lowest.size(); ++i) {
    const double lowest = double{blocks.lowest[i]};
    if (!(double{blocks.highest[i]} >= inner && lowest < inner)) continue;
    boundary += 1;
    bare += lowest < outer ? 1 : 0;
  }
  return boundary > 0 ? bare / boundary : 0;
}

std::optional<double> faintBoundary(const node::BlockRanges& blocks, double boundary) {
  constexpr double kLeast = 0.2;       // of the brighter blocks
  constexpr double kLeastOfField = 1;  // the same without a gap
  constexpr double kSpread = 0.72;     // of the variance explained: no noise
  constexpr double kMost = 1.0 / 3;    // of all
  const std::optional<Parting> parting = partingOf(highestBelow(blocks, boundary));
  if (!parting || !(parting->isGap || parting->explained > kSpread)) return std::nullopt;
  double faint = 0, bright = 0, all = 0;
  forBlocks(blocks, [&](const glm::ivec3& block) {
    const double highest = double{blocks.highest[blocks.index(block)]};
    all += 1;
    if (highest >= boundary)
      bright += 1;
    else if (highest >= parting->value && !isNear(blocks, block, boundary))
      faint += 1;
  });
  const double least = (parting->isGap ? kLeast : kLeastOfField) * bright;
  const bool isMaterial = faint > 0 && faint >= least && faint <= kMost * all;
  return isMaterial ? std::optional{parting->value} : std::nullopt;
}

}  // namespace burin::host
