#include "smoothed_laplacian.hpp"

#include <algorithm>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

std::size_t size(int n) {
  return static_cast<std::size_t>(n);
}

}  // namespace

// 1-4-6-4-1, and its central first and second differences.
const SmoothedLaplacian::Taps SmoothedLaplacian::kSmooth{0,         1.0f / 16, 4.0f / 16, 6.0f / 16,
                                                         4.0f / 16, 1.0f / 16, 0};
const SmoothedLaplacian::Taps SmoothedLaplacian::kFirst{-1.0f / 32, -4.0f / 32, -5.0f / 32, 0,
                                                        5.0f / 32,  4.0f / 32,  1.0f / 32};
const SmoothedLaplacian::Taps SmoothedLaplacian::kSecond{
    1.0f / 16, 2.0f / 16, -1.0f / 16, -4.0f / 16, -1.0f / 16, 2.0f / 16, 1.0f / 16};

SmoothedLaplacian::SmoothedLaplacian(const glm::ivec3& boxSize, const VolumeGrid& grid)
    : size_{boxSize} {
  const glm::dmat3 toIndex = grid.worldToIndex();
  metric_ = toIndex * glm::transpose(toIndex);
  unit_ = std::max({metric_[0][0], metric_[1][1], metric_[2][2]});
  metric_ /= unit_;
  const std::size_t count = size(size_.x) * size(size_.y);
  for (Slice* slice : {&smoothX_, &firstX_, &secondX_, &result_}) slice->resize(count);
}

void SmoothedLaplacian::add(std::span<const float> slice, const Deliver& deliver) {
  BURIN_CHECK_EQ(slice.size(), result_.size());
  BURIN_CHECK(added_ < size_.z);
  filterAlongX(slice);
  filterAlongY(planes_[size(added_ % kTaps)]);
  ++added_;
  const int known = added_ == size_.z ? size_.z : added_ - kLaplacianReach;
  for (; delivered_ < known; ++delivered_) {
    filterAlongZ(delivered_);
    deliver(delivered_, result_);
  }
}

void SmoothedLaplacian::filterAlongX(std::span<const float> slice) {
  const std::size_t width = size(size_.x);
  constexpr std::size_t kReach = kLaplacianReach;
  std::vector<float> padded(width + 2 * kReach);
  for (std::size_t row = 0; row < slice.size(); row += width) {
    const auto values = slice.subspan(row, width);
    std::ranges::copy(values, padded.begin() + kReach);
    std::fill_n(padded.begin(), kReach, values.front());
    std::fill_n(padded.end() - kReach, kReach, values.back());
    for (std::size_t x = 0; x < width; ++x) {
      float smooth = 0, first = 0, second = 0;
      for (std::size_t k = 0; k < kTaps; ++k) {
        smooth += kSmooth[k] * padded[x + k];
        first += kFirst[k] * padded[x + k];
        second += kSecond[k] * padded[x + k];
      }
      smoothX_[row + x] = smooth;
      firstX_[row + x] = first;
      secondX_[row + x] = second;
    }
  }
}

void SmoothedLaplacian::filterAlongY(Plane& plane) const {
  for (Slice* slice : {&plane.toSmooth, &plane.toDeriveOnce, &plane.toDeriveTwice})
    slice->assign(result_.size(), 0.0f);
  addRows(secondX_, kSmooth, metric_[0][0], plane.toSmooth);
  addRows(smoothX_, kSecond, metric_[1][1], plane.toSmooth);
  addRows(firstX_, kFirst, 2 * metric_[0][1], plane.toSmooth);
  addRows(firstX_, kSmooth, 2 * metric_[0][2], plane.toDeriveOnce);
  addRows(smoothX_, kFirst, 2 * metric_[1][2], plane.toDeriveOnce);
  addRows(smoothX_, kSmooth, metric_[2][2], plane.toDeriveTwice);
}

/// to += factor * (from filtered along y)
void SmoothedLaplacian::addRows(const Slice& from, const Taps& taps, double factor,
                                Slice& to) const {
  if (factor == 0) return;
  const std::size_t width = size(size_.x);
  for (int y = 0; y < size_.y; ++y)
    for (int k = 0; k < kTaps; ++k) {
      const int tapped = std::clamp(y + k - kLaplacianReach, 0, size_.y - 1);
      const float* source = from.data() + size(tapped) * width;
      float* target = to.data() + size(y) * width;
      const float weight = static_cast<float>(factor) * taps[size(k)];
      for (std::size_t x = 0; x < width; ++x) target[x] += weight * source[x];
    }
}

void SmoothedLaplacian::filterAlongZ(int z) {
  std::ranges::fill(result_, 0.0f);
  for (int k = 0; k < kTaps; ++k) {
    const int tapped = std::clamp(z + k - kLaplacianReach, 0, added_ - 1);
    const Plane& plane = planes_[size(tapped % kTaps)];
    const float smooth = kSmooth[size(k)], first = kFirst[size(k)], second = kSecond[size(k)];
    for (std::size_t i = 0; i < result_.size(); ++i)
      result_[i] += smooth * plane.toSmooth[i] + first * plane.toDeriveOnce[i] +
                    second * plane.toDeriveTwice[i];
  }
}

}  // namespace burin::node
