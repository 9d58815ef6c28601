#include "reference_laplacian.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace burin::node {
namespace {

/// Values at the voxels of a box.
struct Field {
  glm::ivec3 first{0};
  glm::ivec3 size{0};
  std::vector<double> values;

  Field(const glm::ivec3& givenFirst, const glm::ivec3& givenSize)
      : first{givenFirst},
        size{givenSize},
        values(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
               static_cast<std::size_t>(size.z)) {}

  std::size_t offset(const glm::ivec3& at) const {
    const glm::ivec3 i = glm::clamp(at - first, glm::ivec3{0}, size - 1);
    return static_cast<std::size_t>(i.x) +
           static_cast<std::size_t>(size.x) *
               (static_cast<std::size_t>(i.y) +
                static_cast<std::size_t>(size.y) * static_cast<std::size_t>(i.z));
  }
  double operator()(const glm::ivec3& at) const { return values[offset(at)]; }

  template <typename Value>
  void fill(Value&& value) {
    for (int k = 0; k < size.z; ++k)
      for (int j = 0; j < size.y; ++j)
        for (int i = 0; i < size.x; ++i) {
          const glm::ivec3 at = first + glm::ivec3{i, j, k};
          values[offset(at)] = value(at);
        }
  }
};

glm::ivec3 unit(int axis) {
  glm::ivec3 step{0};
  step[axis] = 1;
  return step;
}

/// One voxel further to both sides than `field`.
Field smoothedAlong(int axis, const Field& field) {
  constexpr double kBinomial[5] = {1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16};
  Field smooth{field.first - unit(axis), field.size + 2 * unit(axis)};
  smooth.fill([&](const glm::ivec3& at) {
    double sum = 0;
    for (int o = -2; o <= 2; ++o) sum += kBinomial[o + 2] * field(at + o * unit(axis));
    return sum;
  });
  return smooth;
}

/// ∂a ∂b by differences.
double secondDifference(const Field& field, const glm::ivec3& at, int a, int b) {
  if (a == b) return field(at + unit(a)) - 2 * field(at) + field(at - unit(a));
  return (field(at + unit(a) + unit(b)) - field(at + unit(a) - unit(b)) -
          field(at - unit(a) + unit(b)) + field(at - unit(a) - unit(b))) /
         4;
}

/// Whether a NaN voxel lies within three voxels along every axis.
bool touchesNan(const Field& field, const glm::ivec3& at) {
  for (int k = -3; k <= 3; ++k)
    for (int j = -3; j <= 3; ++j)
      for (int i = -3; i <= 3; ++i)
        if (std::isnan(field(at + glm::ivec3{i, j, k}))) return true;
  return false;
}

double percentile999(const std::vector<double>& values) {
  std::vector<double> magnitudes;
  for (const double value : values)
    if (!std::isnan(value)) magnitudes.push_back(std::abs(value));
  if (magnitudes.empty()) return 0;
  const std::size_t rank = (magnitudes.size() * 999 + 999) / 1000;  // ⌈0.999 n⌉, counted from 1
  const auto chosen = magnitudes.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(magnitudes.begin(), chosen, magnitudes.end());
  return *chosen;
}

}  // namespace

ReferenceLaplacian::ReferenceLaplacian(const ReferenceVolume& volume,
                                       const std::optional<double>& percentile)
    : dims_{volume.grid().dims} {
  Field voxels{glm::ivec3{0}, dims_};
  voxels.fill([&](const glm::ivec3& at) { return volume.voxelAt(at); });
  const bool hasNan = std::ranges::any_of(voxels.values, [](double v) { return std::isnan(v); });
  Field smooth = voxels;
  for (int axis = 0; axis < 3; ++axis) smooth = smoothedAlong(axis, smooth);

  const glm::dmat3 toIndex = volume.grid().worldToIndex();
  const glm::dmat3 metric = toIndex * glm::transpose(toIndex);
  Field laplacian{glm::ivec3{0}, dims_};
  laplacian.fill([&](const glm::ivec3& at) {
    if (hasNan && touchesNan(voxels, at)) return std::numeric_limits<double>::quiet_NaN();
    double sum = 0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) sum += metric[a][b] * secondDifference(smooth, at, a, b);
    return sum;
  });
  voxels_ = std::move(laplacian.values);
  percentile_ = percentile ? *percentile : percentile999(voxels_);
}

double ReferenceLaplacian::voxel(const glm::ivec3& at) const {
  const glm::ivec3 i = glm::clamp(at, glm::ivec3{0}, dims_ - 1);
  const double value =
      voxels_[static_cast<std::size_t>(i.x) +
              static_cast<std::size_t>(dims_.x) *
                  (static_cast<std::size_t>(i.y) +
                   static_cast<std::size_t>(dims_.y) * static_cast<std::size_t>(i.z))];
  return std::isnan(value) ? 0 : value;
}

double ReferenceLaplacian::at(const glm::dvec3& index) const {
  if (!(percentile_ > 0)) return 0;
  const glm::dvec3 lower = glm::floor(index);
  const glm::dvec3 weight = index - lower;
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 upper{corner & 1, (corner >> 1) & 1, corner >> 2};
    const glm::dvec3 share = glm::mix(1.0 - weight, weight, glm::dvec3{upper});
    sum += share.x * share.y * share.z * voxel(glm::ivec3{lower} + upper);
  }
  return std::clamp(sum / percentile_, -1.0, 1.0);
}

}  // namespace burin::node
