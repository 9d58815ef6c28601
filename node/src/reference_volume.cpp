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

/// Central differences at a voxel, per index unit, its neighbours clamped at the volume's border.
/// NaN if a neighbour is.
template <typename T>
glm::dvec3 gradientAtVoxel(const std::vector<T>& voxels, const glm::ivec3& at,
                           const glm::ivec3& dims) {
  const std::size_t strides[3] = {1, size(dims.x), size(dims.x) * size(dims.y)};
  const std::size_t here = size(at.x) + strides[1] * size(at.y) + strides[2] * size(at.z);
  glm::dvec3 gradient{0};
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t above = here + (at[axis] + 1 < dims[axis] ? strides[axis] : 0);
    const std::size_t below = here - (at[axis] > 0 ? strides[axis] : 0);
    gradient[axis] = (static_cast<double>(voxels[above]) - static_cast<double>(voxels[below])) / 2;
  }
  return gradient;
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

glm::dvec3 ReferenceVolume::gradientAt(const glm::dvec3& index) const {
  glm::dvec3 perIndex{0};
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 above = index;
    glm::dvec3 below = index;
    above[axis] += 1;
    below[axis] -= 1;
    const auto upper = valueAt(above);
    const auto lower = valueAt(below);
    if (!upper || !lower) return glm::dvec3{0};
    perIndex[axis] = (*upper - *lower) / 2;
  }
  return worldFromIndexGradient_ * perIndex;
}

std::vector<double> ReferenceVolume::gradientMagnitudes() const {
  std::vector<double> magnitudes;
  magnitudes.reserve(grid_.voxelCount());
  std::visit(
      [&](const auto& voxels) {
        std::size_t here = 0;
        for (int k = 0; k < grid_.dims.z; ++k)
          for (int j = 0; j < grid_.dims.y; ++j)
            for (int i = 0; i < grid_.dims.x; ++i, ++here) {
              if (std::isnan(static_cast<double>(voxels[here]))) continue;
              const glm::dvec3 gradient = gradientAtVoxel(voxels, {i, j, k}, grid_.dims);
              const double magnitude = glm::length(worldFromIndexGradient_ * gradient);
              if (!std::isnan(magnitude)) magnitudes.push_back(magnitude);
            }
      },
      voxels_);
  return magnitudes;
}

}  // namespace burin::node
