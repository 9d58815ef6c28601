#include "brick_loading.hpp"

#include <fmt/format.h>

#include <vector>

#include "burin/common/trace.hpp"
#include "burin/node/survey.hpp"
#include "label_voxels.hpp"

namespace burin::node {

MemoryNeed memoryNeedOf(std::span<const IndexBox> boxes, const VolumeInfo& volume,
                        const ValueScale& scale, bool hasLaplacian, const LabelMasks& masks) {
  /// Macrocells and distance maps beside the texels; `resident_voxel_bytes` is held to it.
  constexpr double kWithMaps = 1.2;
  std::size_t voxels = 0;
  for (const IndexBox& box : boxes) voxels += box.count();
  const std::size_t perVoxel = bytesPerTexel(volume.type, scale.hasInvalid) +
                               (hasLaplacian ? sizeof(float) : 0) +
                               (masks.sets().empty() ? 0 : bytesPerLabelTexel(masks.sets().size()));
  const std::size_t texels = voxels * perVoxel;
  return {
      static_cast<std::int64_t>(kWithMaps * static_cast<double>(texels)),
      fmt::format("{} brick{} with {} voxels", boxes.size(), boxes.size() == 1 ? "" : "s", voxels)};
}

void loadBricks(const Communicator& comm, BrickSource& source, std::span<const IndexBox> boxes,
                std::span<Brick> bricks) {
  constexpr std::size_t kSlabBytes = std::size_t{8} << 20;
  const TraceSpan loading{"load"};
  StagingBuffer staging;
  readSlabs(
      comm, source, boxes,
      [&](const Slab& slab) {
        const TraceSpan span{"upload"};
        bricks[slab.request].upload(slab.box, slab.voxels, staging);
      },
      kSlabBytes);
}

void loadLabels(const Communicator& comm, BrickSource& labels, const LabelMasks& masks, int reach,
                std::span<Brick> bricks) {
  const TraceSpan loading{"load labels"};
  std::vector<IndexBox> boxes;
  collectively(comm, "making room for labels", [&] {
    for (Brick& brick : bricks) {
      brick.makeLabels(masks.sets().size(), reach);
      boxes.push_back(brick.storedVoxels());
    }
  });
  std::vector<int> numbers;
  std::vector<MaskBits> bits;
  const auto take = [&](const Slab& slab) {
    readLabels(labels.info(), slab.voxels, numbers);
    masks.bitsOf(numbers, bits);
    bricks[slab.request].uploadLabels(slab.box, bits);
  };
  // A label takes its number and its bits beside its voxel, 6 bytes.
  constexpr std::size_t kLabelsOfSlab = std::size_t{1} << 20;
  readSlabs(comm, labels, boxes, take, kLabelsOfSlab * bytesPerVoxel(labels.info().type));
}

}  // namespace burin::node
