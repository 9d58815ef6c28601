#include "brick.hpp"

#include <algorithm>

#include "chessboard_distance.hpp"
#include "dilated_marks.hpp"

namespace burin::node {

IndexBox storedVoxels(const IndexBox& cells, int ghostLayers, const VolumeGrid& grid) {
  return {glm::max(cells.lo - ghostLayers, glm::ivec3{0}),
          glm::min(cells.hi + 1 + ghostLayers, grid.dims)};
}

Brick::Brick(BrickId id, const IndexBox& cells, int ghostLayers, const VolumeInfo& volume,
             const ValueScale& scale, const std::optional<double>& laplacian999)
    : id_{id},
      grid_{volume.grid},
      cells_{cells},
      ghostLayers_{ghostLayers},
      texture_{burin::node::storedVoxels(cells, ghostLayers, volume.grid), volume.type, scale},
      macrocells_{texture_.storedVoxels(), volume.type != VoxelType::kF32},
      map_{makeTexture(GL_TEXTURE_3D)} {
  if (laplacian999) laplacian_.emplace(texture_.storedVoxels(), volume.grid, scale, *laplacian999);
  const glm::ivec3 size = macrocells_.size();
  gl().TextureStorage3D(map_.id(), 1, GL_R16I, size.x, size.y, size.z);
  gl().TextureParameteri(map_.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl().TextureParameteri(map_.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  checkGl("making a map of macrocells");
}

void Brick::upload(const IndexBox& box, std::span<const std::byte> voxels, StagingBuffer& staging) {
  texture_.upload(box, voxels, staging);
  macrocells_.add(box, staging.values);
  if (laplacian_) laplacian_->add(staging.values);
}

void Brick::makeLabels(std::size_t masks, int reach) {
  labels_.reset();
  labels_.emplace(texture_.storedVoxels(), macrocells_.cubes(), masks, reach);
}

void Brick::uploadLabels(const IndexBox& box, std::span<const MaskBits> masks) {
  labels_->upload(box, masks);
}

/// Per macrocell the octants in which some group shows something.
std::vector<OctantMask> Brick::marksOf(std::span<const VisibleGroup> groups) const {
  std::vector<OctantMask> marks(IndexBox{glm::ivec3{0}, macrocells_.size()}.count());
  for (const VisibleGroup& group : groups) {
    std::vector<OctantMask> part = macrocells_.mark(group.values);
    if (const int reach = group.values.reach(kMacrocellSize); reach > 0) {
      dilateMarks(part, macrocells_.size(), reach);
      for (OctantMask& mask : part) mask = mask != 0 ? kAllOctants : OctantMask{0};
    }
    for (std::size_t i = 0; i < marks.size(); ++i)
      if (!group.mask || (labels_->occurring()[i] >> *group.mask & 1) != 0) marks[i] |= part[i];
  }
  return marks;
}

void Brick::classify(std::span<const VisibleGroup> groups, std::span<const glm::vec4> clipPlanes) {
  std::vector<OctantMask> marks = marksOf(groups);
  clearClipped(marks, macrocells_.cubes(), clipPlanes, grid_);
  const IndexBox marked = macrocells_.boxOf(marks);
  visibleCells_ = marked.empty()
                      ? marked
                      : intersection({marked.lo - ghostLayers_, marked.hi + ghostLayers_}, cells_);
  const glm::ivec3 size = macrocells_.size();
  const std::vector<std::uint8_t> distances = chessboardDistance(marks, size);
  std::vector<std::int16_t> texels(marks.size());
  for (std::size_t i = 0; i < texels.size(); ++i)  // one of the two is 0
    texels[i] = static_cast<std::int16_t>(distances[i] - marks[i]);
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl().TextureSubImage3D(map_.id(), 0, 0, 0, 0, size.x, size.y, size.z, GL_RED_INTEGER, GL_SHORT,
                         texels.data());
  checkGl("uploading a map of macrocells");
}

std::size_t Brick::residentBytes() const {
  const glm::ivec3 size = macrocells_.size();
  return texture_.bytes() + (laplacian_ ? laplacian_->bytes() : 0) +
         (labels_ ? labels_->bytes() : 0) + macrocells_.bytes() +
         IndexBox{glm::ivec3{0}, size}.count() * sizeof(std::int16_t);
}

}  // namespace burin::node
