#include "gradient_survey.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "burin/common/error.hpp"
#include "voxel_access.hpp"

namespace burin::node {
namespace {

constexpr int kMantissaBits = 10;
constexpr int kDroppedBits = 23 - kMantissaBits;
constexpr std::size_t kBins = std::size_t{1} << (8 + kMantissaBits);

}  // namespace

MagnitudeHistogram::MagnitudeHistogram() : counts_(1 + kBins) {}

void MagnitudeHistogram::add(float magnitude) {
  const std::size_t bin = std::bit_cast<std::uint32_t>(magnitude) >> kDroppedBits;
  ++counts_[magnitude == 0 ? 0 : 1 + bin];
}

void MagnitudeHistogram::addZeros(std::int64_t count) {
  counts_[0] += count;
}

double MagnitudeHistogram::percentile(double fraction) const {
  const std::int64_t total = std::accumulate(counts_.begin(), counts_.end(), std::int64_t{0});
  if (total == 0) return 0;
  const double wanted = fraction * static_cast<double>(total);
  std::int64_t seen = 0;
  std::size_t at = 0;
  while (at < counts_.size()) {
    seen += counts_[at];
    if (static_cast<double>(seen) >= wanted) break;
    ++at;
  }
  if (at == 0) return 0;
  return double{std::bit_cast<float>(static_cast<std::uint32_t>(at) << kDroppedBits)};
}

GradientSurvey::GradientSurvey(GradientOperator which, const VolumeInfo& info, int firstZ,
                               int lastZ, float lowest, float highest)
    : which_{which},
      weights_{operatorWeights(which)},
      type_{info.type},
      dims_{info.grid.dims},
      firstZ_{firstZ},
      lastZ_{lastZ},
      lowest_{lowest},
      highest_{highest} {
  // Index differences d across two voxels: ∇_index = d/2, ∇_world = J⁻ᵀ ∇_index.
  const glm::dmat3 toIndex = info.grid.worldToIndex();
  metric_ = 0.25 * toIndex * glm::transpose(toIndex);
  const std::size_t count = static_cast<std::size_t>(dims_.x) * static_cast<std::size_t>(dims_.y);
  for (auto& slice : slices_) slice.resize(count);
  for (auto* row : {&alongX_, &alongY_, &alongZ_, &squares_})
    row->resize(static_cast<std::size_t>(dims_.x));
}

double GradientSurvey::largest() const {
  return std::sqrt(largestSquare_);
}

void GradientSurvey::addSlice(int z, std::span<const std::byte> voxels) {
  widenToFloat(type_, voxels, lowest_, highest_, slice(z));
  if (z - 1 >= firstZ_ && z - 1 < lastZ_) measureSlice(z - 1);
  if (z == dims_.z - 1 && z >= firstZ_ && z < lastZ_) measureSlice(z);
}

void GradientSurvey::measureSlice(int z) {
  for (int y = 0; y < dims_.y; ++y) {
    differencesAlongX(row(y, z));
    addPair(row(y + 1, z), row(y - 1, z), {1, 0}, weights_.face, weights_.edge);
    addPair(row(y, z + 1), row(y, z - 1), {0, 1}, weights_.face, weights_.edge);
    if (weights_.edge > 0) {
      addPair(row(y + 1, z + 1), row(y - 1, z - 1), {1, 1}, weights_.edge, weights_.corner);
      addPair(row(y - 1, z + 1), row(y + 1, z - 1), {-1, 1}, weights_.edge, weights_.corner);
    }
    countMagnitudes();
  }
}

GradientSurvey::Row GradientSurvey::row(int y, int z) {
  const auto number = static_cast<std::size_t>(std::clamp(y, 0, dims_.y - 1));
  return slice(std::clamp(z, 0, dims_.z - 1)).data() + number * alongX_.size();
}

template <typename Work>
void GradientSurvey::forNeighbours(Work&& work) const {
  const std::size_t last = alongX_.size() - 1;
  work(std::size_t{0}, std::size_t{0}, std::min<std::size_t>(1, last));
  for (std::size_t x = 1; x < last; ++x) work(x, x - 1, x + 1);
  if (last > 0) work(last, last - 1, last);
}

void GradientSurvey::differencesAlongX(Row here) {
  forNeighbours([&](std::size_t x, std::size_t below, std::size_t above) {
    const double centre = double{here[x]} - double{here[x]};  // 0, or NaN at a NaN voxel
    const double difference = double{here[above]} - double{here[below]};
    alongX_[x] = weights_.face * difference + centre;
  });
  std::ranges::fill(alongY_, 0);
  std::ranges::fill(alongZ_, 0);
}

void GradientSurvey::addPair(Row above, Row below, const glm::dvec2& direction, double straight,
                             double oblique) {
  for (std::size_t x = 0; x < alongX_.size(); ++x) {
    const double across = straight * (double{above[x]} - double{below[x]});
    alongY_[x] += direction.x * across;
    alongZ_[x] += direction.y * across;
  }
  if (oblique > 0) addObliquePairs(above, below, direction, oblique);
}

void GradientSurvey::addObliquePairs(Row above, Row below, const glm::dvec2& direction,
                                     double oblique) {
  forNeighbours([&](std::size_t x, std::size_t xBelow, std::size_t xAbove) {
    const double rising = double{above[xAbove]} - double{below[xBelow]};
    const double falling = double{above[xBelow]} - double{below[xAbove]};
    const double across = oblique * (rising + falling);
    alongX_[x] += oblique * (rising - falling);
    alongY_[x] += direction.x * across;
    alongZ_[x] += direction.y * across;
  });
}

void GradientSurvey::countMagnitudes() {
  const double xx = metric_[0][0], yy = metric_[1][1], zz = metric_[2][2];
  const double xy = 2 * metric_[0][1], xz = 2 * metric_[0][2], yz = 2 * metric_[1][2];
  for (std::size_t i = 0; i < squares_.size(); ++i) {
    const double x = alongX_[i], y = alongY_[i], z = alongZ_[i];
    squares_[i] = x * (xx * x + xy * y + xz * z) + y * (yy * y + yz * z) + zz * z * z;
  }
  std::int64_t zeros = 0;
  for (const double square : squares_) {
    if (square == 0) {  // most voxels of many scans, and no root of theirs is needed
      ++zeros;
      continue;
    }
    if (!(square <= std::numeric_limits<double>::max())) continue;
    largestSquare_ = std::max(largestSquare_, square);
    // A float holds magnitudes up to 3e38; larger ones share the last bin.
    const double magnitude = std::sqrt(std::max(square, 0.0));
    histogram_.add(
        static_cast<float>(std::min(magnitude, double{std::numeric_limits<float>::max()})));
  }
  histogram_.addZeros(zeros);
}

}  // namespace burin::node
