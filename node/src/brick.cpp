#include "brick.hpp"

#include <algorithm>

namespace burin::node {

IndexBox storedVoxels(const IndexBox& cells, int ghostLayers, const VolumeGrid& grid) {
  return {glm::max(cells.lo - ghostLayers, glm::ivec3{0}),
          glm::min(cells.hi + 1 + ghostLayers, grid.dims)};
}

Brick::Brick(BrickId id, const IndexBox& cells, int ghostLayers, const VolumeInfo& volume,
             const ValueScale& scale)
    : id_{id},
      cells_{cells},
      texture_{burin::node::storedVoxels(cells, ghostLayers, volume.grid), volume.type, scale},
      macrocells_{texture_.storedVoxels()},
      distances_{makeTexture(GL_TEXTURE_3D)} {
  const glm::ivec3 size = macrocells_.size();
  gl().TextureStorage3D(distances_.id(), 1, GL_R8UI, size.x, size.y, size.z);
  gl().TextureParameteri(distances_.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl().TextureParameteri(distances_.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  checkGl("making a distance map");
}

void Brick::upload(const IndexBox& box, std::span<const std::byte> voxels, StagingBuffer& staging) {
  texture_.upload(box, voxels, staging);
  macrocells_.add(box, staging.values);
}

void Brick::classify(const Scene& scene, std::span<const TransferTable> tables,
                     const ValueScale& scale) {
  const auto visible = [&](float lowest, float highest) {
    for (std::size_t i = 0; i < tables.size(); ++i) {
      const TransferFunction& function = scene.layers[i].transferFunction;
      const double bin = tables[i].binWidth();
      if (function.largestExtinction(scale.value(double{lowest}) - bin,
                                     scale.value(double{highest}) + bin,
                                     function.opacityUnitLength.value()) > 0)
        return true;
    }
    return false;
  };
  const std::vector<std::uint8_t> distances = macrocells_.distances(visible);
  visibleCells_ = intersection(macrocells_.visibleCells(distances), cells_);
  const glm::ivec3 size = macrocells_.size();
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl().TextureSubImage3D(distances_.id(), 0, 0, 0, 0, size.x, size.y, size.z, GL_RED_INTEGER,
                         GL_UNSIGNED_BYTE, distances.data());
  checkGl("uploading a distance map");
}

std::size_t Brick::residentBytes() const {
  const glm::ivec3 size = macrocells_.size();
  return texture_.bytes() + macrocells_.bytes() + IndexBox{glm::ivec3{0}, size}.count();
}

}  // namespace burin::node
