#include "reference_volume.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace burin::node {
namespace {

std::size_t size(int n) {
  return static_cast<std::size_t>(n);
}

/// The two voxels that a coordinate lies between on one axis, and the weight of the upper one.
struct Between {
  std::size_t lower = 0;
  std::size_t upper = 0;
  double weight = 0;
};

Between between(double coordinate, int voxels) {
  const int last = voxels - 1;
  const double at = std::clamp(coordinate, 0.0, static_cast<double>(last));
  const int lower = std::min(static_cast<int>(at), std::max(last - 1, 0));
  return {size(lower), size(std::min(lower + 1, last)), at - lower};
}

/// The eight voxels around a position, with their trilinear weights.
class Corners {
 public:
  Corners(const glm::dvec3& index, const glm::ivec3& dims)
      : x_{between(index.x, dims.x)},
        y_{between(index.y, dims.y)},
        z_{between(index.z, dims.z)},
        rowLength_{size(dims.x)},
        rowsPerSlice_{size(dims.y)} {}

  /// visit(offset of a voxel, its weight), eight times.
  template <typename Visit>
  void forEach(Visit&& visit) const {
    for (const auto& [z, wz] : {std::pair{z_.lower, 1 - z_.weight}, std::pair{z_.upper, z_.weight}})
      for (const auto& [y, wy] :
           {std::pair{y_.lower, 1 - y_.weight}, std::pair{y_.upper, y_.weight}}) {
        const std::size_t row = rowLength_ * (y + rowsPerSlice_ * z);
        visit(row + x_.lower, wz * wy * (1 - x_.weight));
        visit(row + x_.upper, wz * wy * x_.weight);
      }
  }

 private:
  Between x_, y_, z_;
  std::size_t rowLength_;
  std::size_t rowsPerSlice_;
};

/// What value(offset), offset in {-1, 0, 1}³, says of the gradient in the middle, per index unit.
template <typename Value>
glm::dvec3 centralGradient(const Value& value) {
  glm::dvec3 gradient{0};
  for (int axis = 0; axis < 3; ++axis) {
    glm::ivec3 step{0};
    step[axis] = 1;
    gradient[axis] = (value(step) - value(-step)) / 2;
  }
  return gradient;
}

template <typename Value>
glm::dvec3 sobelGradient(const Value& value) {
  glm::dvec3 gradient{0};
  for (int axis = 0; axis < 3; ++axis)
    for (int u = -1; u <= 1; ++u)
      for (int v = -1; v <= 1; ++v) {
        glm::ivec3 step{0};
        step[axis] = 1;
        glm::ivec3 aside{0};
        aside[(axis + 1) % 3] = u;
        aside[(axis + 2) % 3] = v;
        const double weight = (u == 0 ? 0.5 : 0.25) * (v == 0 ? 0.5 : 0.25);
        gradient[axis] += weight * (value(aside + step) - value(aside - step)) / 2;
      }
  return gradient;
}

/// Over a symmetric neighbourhood the normal equations are diagonal: Σ w o f / Σ w o².
template <typename Value>
glm::dvec3 regressionGradient(const Value& value) {
  glm::dvec3 moments{0};
  glm::dvec3 squares{0};
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const glm::ivec3 offset{x, y, z};
        if (offset == glm::ivec3{0}) continue;
        const glm::dvec3 o{offset};
        const double weight = 1 / glm::length(o);
        moments += weight * value(offset) * o;
        squares += weight * o * o;
      }
  return moments / squares;
}

template <typename Value>
glm::dvec3 gradientOf(const Value& value, GradientOperator which) {
  if (which == GradientOperator::kSobel) return sobelGradient(value);
  return which == GradientOperator::kRegression ? regressionGradient(value)
                                                : centralGradient(value);
}

template <typename T>
std::vector<T> readAll(BrickSource& source) {
  const VolumeGrid& grid = source.info().grid;
  std::vector<T> voxels(grid.voxelCount());
  source.load({glm::ivec3{0}, grid.dims}, std::as_writable_bytes(std::span{voxels}));
  return voxels;
}

}  // namespace

ReferenceVolume::ReferenceVolume(BrickSource& source)
    : grid_{source.info().grid},
      indexFromWorld_{grid_.worldToIndex()},
      // A gradient is a covector: with w = M i, ∇_w f = M^-T ∇_i f.
      worldFromIndexGradient_{glm::transpose(glm::inverse(grid_.indexToWorld()))} {
  switch (source.info().type) {
    case VoxelType::kU8:
      voxels_ = readAll<std::uint8_t>(source);
      break;
    case VoxelType::kI16:
      voxels_ = readAll<std::int16_t>(source);
      break;
    case VoxelType::kU16:
      voxels_ = readAll<std::uint16_t>(source);
      break;
    case VoxelType::kF32:
      voxels_ = readAll<float>(source);
      cleanFloats();
      break;
  }
}

void ReferenceVolume::cleanFloats() {
  auto& voxels = std::get<std::vector<float>>(voxels_);
  float lowest = std::numeric_limits<float>::max();
  float highest = std::numeric_limits<float>::lowest();
  for (const float value : voxels) {
    if (!std::isfinite(value)) continue;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  if (lowest > highest) lowest = highest = 0;
  for (float& value : voxels) {
    if (std::isinf(value)) value = value < 0 ? lowest : highest;
    hasNan_ = hasNan_ || std::isnan(value);
  }
}

double ReferenceVolume::voxelAt(const glm::ivec3& index) const {
  const glm::ivec3 c = glm::clamp(index, glm::ivec3{0}, grid_.dims - 1);
  const std::size_t at =
      size(c.x) + size(grid_.dims.x) * (size(c.y) + size(grid_.dims.y) * size(c.z));
  return std::visit([at](const auto& voxels) { return static_cast<double>(voxels[at]); }, voxels_);
}

std::optional<double> ReferenceVolume::valueAt(const glm::dvec3& index) const {
  const Corners corners{index, grid_.dims};
  return std::visit(
      [&](const auto& voxels) -> std::optional<double> {
        double sum = 0;
        if (!hasNan_) {
          corners.forEach([&](std::size_t at, double weight) {
            sum += weight * static_cast<double>(voxels[at]);
          });
          return sum;
        }
        double valid = 0;
        corners.forEach([&](std::size_t at, double weight) {
          const auto value = static_cast<double>(voxels[at]);
          if (std::isnan(value)) return;
          sum += weight * value;
          valid += weight;
        });
        if (valid < 0.5) return std::nullopt;
        return sum / valid;
      },
      voxels_);
}

glm::dvec3 ReferenceVolume::gradientAt(const glm::dvec3& index, GradientOperator which) const {
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  const auto value = [&](const glm::ivec3& offset) {
    return valueAt(index + glm::dvec3{offset}).value_or(kMissing);
  };
  const glm::dvec3 perIndex = gradientOf(value, which);
  if (glm::any(glm::isnan(perIndex))) return glm::dvec3{0};
  return worldFromIndexGradient_ * perIndex;
}

std::vector<double> ReferenceVolume::gradientMagnitudes(GradientOperator which) const {
  std::vector<double> magnitudes;
  magnitudes.reserve(grid_.voxelCount());
  for (int k = 0; k < grid_.dims.z; ++k)
    for (int j = 0; j < grid_.dims.y; ++j)
      for (int i = 0; i < grid_.dims.x; ++i) {
        const glm::ivec3 here{i, j, k};
        if (std::isnan(voxelAt(here))) continue;
        const auto value = [&](const glm::ivec3& offset) { return voxelAt(here + offset); };
        const double magnitude = glm::length(worldFromIndexGradient_ * gradientOf(value, which));
        if (!std::isnan(magnitude)) magnitudes.push_back(magnitude);
      }
  return magnitudes;
}

}  // namespace burin::node
