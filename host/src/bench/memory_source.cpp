#include "bench/memory_source.hpp"

#include <utility>

#include "burin/common/error.hpp"

namespace burin::host::bench {

MemorySource::MemorySource(node::VolumeInfo info, std::vector<std::byte> voxels)
    : info_{std::move(info)}, voxels_{std::move(voxels)} {
  BURIN_CHECK(voxels_.size() == info_.bytes());
}

void MemorySource::load(const IndexBox& region, std::span<std::byte> out) {
  node::checkLoad(info_, region, out);
  const IndexBox all{glm::ivec3{0}, info_.grid.dims};
  node::copyVoxels(voxels_, all, out, region, region, node::bytesPerVoxel(info_.type));
}

std::unique_ptr<node::BrickSource> inMemory(node::BrickSource& source) {
  std::vector<std::byte> voxels(source.info().bytes());
  source.load({glm::ivec3{0}, source.info().grid.dims}, voxels);
  return std::make_unique<MemorySource>(source.info(), std::move(voxels));
}

}  // namespace burin::host::bench
