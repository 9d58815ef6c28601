#include "laplacian_survey.hpp"

#include <algorithm>
#include <cmath>

#include "voxel_access.hpp"

namespace burin::node {
namespace {

glm::ivec3 sizeOfSlices(const glm::ivec3& dims, int firstZ, int lastZ) {
  return {dims.x, dims.y,
          std::min(lastZ + kLaplacianReach, dims.z) - std::max(firstZ - kLaplacianReach, 0)};
}

}  // namespace

LaplacianSurvey::LaplacianSurvey(const VolumeInfo& info, int firstZ, int lastZ, float lowest,
                                 float highest)
    : type_{info.type},
      begin_{std::max(firstZ - kLaplacianReach, 0)},
      firstZ_{firstZ},
      lastZ_{lastZ},
      lowest_{lowest},
      highest_{highest},
      filter_{sizeOfSlices(info.grid.dims, firstZ, lastZ), info.grid},
      values_(static_cast<std::size_t>(info.grid.dims.x) *
              static_cast<std::size_t>(info.grid.dims.y)) {}

void LaplacianSurvey::addSlice(std::span<const std::byte> voxels) {
  widenToFloat(type_, voxels, lowest_, highest_, values_);
  filter_.add(values_, [&](int number, std::span<const float> laplacian) {
    const int z = begin_ + number;
    if (z < firstZ_ || z >= lastZ_) return;
    for (const float value : laplacian)
      if (std::isfinite(value)) histogram_.add(std::abs(value));
  });
}

}  // namespace burin::node
