#include "label_voxels.hpp"

#include <cmath>
#include <type_traits>

#include "burin/common/error.hpp"
#include "burin/common/labels.hpp"
#include "voxel_access.hpp"

namespace burin::node {
namespace {

int labelOf(const VolumeInfo& info, float voxel) {
  if (!(std::abs(voxel) <= static_cast<float>(kLargestLabel)) || std::trunc(voxel) != voxel)
    fail(ExitCode::kVolume, "{}: {} is no label (expected whole numbers from {} to {})", info.name,
         voxel, -kLargestLabel, kLargestLabel);
  return static_cast<int>(voxel);
}

}  // namespace

void readLabels(const VolumeInfo& info, std::span<const std::byte> voxels,
                std::vector<int>& labels) {
  BURIN_CHECK_EQ(voxels.size() % bytesPerVoxel(info.type), 0u);
  labels.resize(voxels.size() / bytesPerVoxel(info.type));
  withVoxelType(info.type, [&](auto tag) {
    using Voxel = typename decltype(tag)::Type;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const auto voxel = voxelAt<Voxel>(voxels.data(), i);
      if constexpr (std::is_integral_v<Voxel>)
        labels[i] = voxel;
      else
        labels[i] = labelOf(info, voxel);
    }
  });
}

}  // namespace burin::node
