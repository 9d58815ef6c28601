#include "scaled_source.hpp"

#include <cstring>
#include <utility>

#include "voxel_access.hpp"

namespace burin::node {

ScaledSource::ScaledSource(std::unique_ptr<BrickSource> stored, double slope, double intercept)
    : stored_{std::move(stored)}, info_{stored_->info()}, slope_{slope}, intercept_{intercept} {
  info_.type = VoxelType::kF32;
}

void ScaledSource::load(const IndexBox& region, std::span<std::byte> out) {
  checkLoad(info_, region, out);
  const VoxelType storedType = stored_->info().type;
  scratch_.resize(region.count() * bytesPerVoxel(storedType));
  stored_->load(region, scratch_);
  withVoxelType(storedType, [&](auto tag) {
    using Voxel = typename decltype(tag)::Type;
    for (std::size_t i = 0; i < region.count(); ++i) {
      const double value = static_cast<double>(voxelAt<Voxel>(scratch_.data(), i));
      const auto scaled = static_cast<float>(value * slope_ + intercept_);
      std::memcpy(out.data() + i * sizeof scaled, &scaled, sizeof scaled);
    }
  });
}

}  // namespace burin::node
