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

GradientSurvey::GradientSurvey(const VolumeInfo& info, int firstZ, int lastZ, float lowest,
                               float highest)
    : type_{info.type},
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
  squares_.resize(static_cast<std::size_t>(dims_.x));
}

double GradientSurvey::largest() const {
  return std::sqrt(largestSquare_);
}

void GradientSurvey::addSlice(int z, std::span<const std::byte> voxels) {
  std::vector<float>& values = slice(z);
  widenToFloat(type_, voxels, values);
  if (type_ == VoxelType::kF32) {
    // Written so that NaN stays NaN.
    for (float& value : values) {
      value = value < lowest_ ? lowest_ : value;
      value = value > highest_ ? highest_ : value;
    }
  }
  if (z - 1 >= firstZ_ && z - 1 < lastZ_) measureSlice(z - 1);
  if (z == dims_.z - 1 && z >= firstZ_ && z < lastZ_) measureSlice(z);
}

void GradientSurvey::measureSlice(int z) {
  const auto width = static_cast<std::size_t>(dims_.x);
  const float* here = slice(z).data();
  const float* below = slice(std::max(z - 1, 0)).data();
  const float* above = slice(std::min(z + 1, dims_.z - 1)).data();
  for (int y = 0; y < dims_.y; ++y) {
    const auto row = static_cast<std::size_t>(y) * width;
    const auto rowBelow = static_cast<std::size_t>(std::max(y - 1, 0)) * width;
    const auto rowAbove = static_cast<std::size_t>(std::min(y + 1, dims_.y - 1)) * width;
    measureRow(here + row, here + rowBelow, here + rowAbove, below + row, above + row);
  }
}

void GradientSurvey::measureRow(Row here, Row yBelow, Row yAbove, Row zBelow, Row zAbove) {
  const double xx = metric_[0][0], yy = metric_[1][1], zz = metric_[2][2];
  const double xy = 2 * metric_[0][1], xz = 2 * metric_[0][2], yz = 2 * metric_[1][2];
  double* squares = squares_.data();
  const auto square = [&](std::size_t x, std::size_t xBelow, std::size_t xAbove) {
    const double dx = double{here[xAbove]} - double{here[xBelow]};
    const double dy = double{yAbove[x]} - double{yBelow[x]};
    const double dz = double{zAbove[x]} - double{zBelow[x]};
    const double centre = double{here[x]} - double{here[x]};  // 0, or NaN at a NaN voxel
    squares[x] =
        dx * (xx * dx + xy * dy + xz * dz) + dy * (yy * dy + yz * dz) + zz * dz * dz + centre;
  };
  const std::size_t last = squares_.size() - 1;
  square(0, 0, std::min<std::size_t>(1, last));
  for (std::size_t x = 1; x < last; ++x) square(x, x - 1, x + 1);
  if (last > 0) square(last, last - 1, last);

  for (const double value : squares_) {
    if (!(value <= std::numeric_limits<double>::max())) continue;
    largestSquare_ = std::max(largestSquare_, value);
    // A float holds magnitudes up to 3e38; larger ones share the last bin.
    const double magnitude = std::sqrt(std::max(value, 0.0));
    histogram_.add(
        static_cast<float>(std::min(magnitude, double{std::numeric_limits<float>::max()})));
  }
}

}  // namespace burin::node
