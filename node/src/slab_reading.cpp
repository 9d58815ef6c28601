#include "slab_reading.hpp"

#include <algorithm>
#include <vector>

#include "burin/common/error.hpp"

namespace burin::node {

int slicesPerSlab(std::size_t sliceBytes, std::size_t slabBytes) {
  constexpr std::size_t kMost = std::size_t{1} << 30;
  return static_cast<int>(std::clamp<std::size_t>(slabBytes / sliceBytes, 1, kMost));
}

void readOwnSlabs(BrickSource& source, std::span<const IndexBox> boxes, const DeliverSlab& deliver,
                  std::size_t slabBytes) {
  const std::size_t voxelBytes = bytesPerVoxel(source.info().type);
  std::vector<std::byte> voxels;
  for (std::size_t request = 0; request < boxes.size(); ++request) {
    const IndexBox& box = boxes[request];
    if (box.empty()) continue;
    const std::size_t sliceBytes =
        box.count() / static_cast<std::size_t>(box.size().z) * voxelBytes;
    const int thickness = std::min(slicesPerSlab(sliceBytes, slabBytes), box.size().z);
    for (int z = box.lo.z; z < box.hi.z; z += thickness) {
      const IndexBox part{{box.lo.x, box.lo.y, z},
                          {box.hi.x, box.hi.y, std::min(z + thickness, box.hi.z)}};
      voxels.resize(part.count() * voxelBytes);
      source.load(part, voxels);
      deliver({request, part, voxels});
    }
  }
}

void readSlabs(const Communicator& comm, BrickSource& source, std::span<const IndexBox> boxes,
               const std::function<void(const Slab&)>& deliver, std::size_t slabBytes) {
  const IndexBox volume{glm::ivec3{0}, source.info().grid.dims};
  for (const IndexBox& box : boxes) BURIN_CHECK(box.empty() || volume.contains(box));
  const auto what = fmt::format("reading {}", source.info().name);
  if (source.randomAccess()) {
    collectively(comm, what, [&] { readOwnSlabs(source, boxes, deliver, slabBytes); });
  } else {
    agree(comm, what, scatterSlabs(comm, source, boxes, deliver, slabBytes));
  }
}

}  // namespace burin::node
