#pragma once

#include <optional>
#include <span>

#include "brick_texture.hpp"
#include "burin/common/brick_tree.hpp"
#include "label_texture.hpp"
#include "laplacian_texture.hpp"
#include "macrocells.hpp"
#include "visible_group.hpp"

namespace burin::node {

/// One brick on this rank: its voxels as a texture, their macrocells, and what of them the current
/// transfer functions can show.
class Brick {
 public:
  /// `cells`: those of the tree's brick that are stored and drawn; the others show nothing.
  /// `ghostLayers`: voxels loaded beyond them, clamped at the volume. `laplacian999`: as of
  /// LaplacianTexture, if there is to be one.
  Brick(BrickId id, const IndexBox& cells, int ghostLayers, const VolumeInfo& volume,
        const ValueScale& scale, const std::optional<double>& laplacian999);

  /// Slabs of the stored voxels, whole in x and y, in ascending z.
  void upload(const IndexBox& box, std::span<const std::byte> voxels, StagingBuffer& staging);
  /// After the last upload.
  void finishLoading() { macrocells_.finish(); }

  /// Room for so many masks of labels, in place of those before. `reach`: as of SetsOfCubes.
  void makeLabels(std::size_t masks, int reach);
  /// The masks of stored voxels, as upload().
  void uploadLabels(const IndexBox& box, std::span<const MaskBits> masks);

  /// Map of macrocells and visible cells for what the scene shows now. `clipPlanes`: as of
  /// centredClipPlanes().
  void classify(std::span<const VisibleGroup> groups, std::span<const glm::vec4> clipPlanes);

  BrickId id() const { return id_; }
  const IndexBox& cells() const { return cells_; }
  const IndexBox& storedVoxels() const { return texture_.storedVoxels(); }
  GLuint volumeTexture() const { return texture_.id(); }
  GLuint mapTexture() const { return map_.id(); }
  /// 0 if there is none.
  GLuint laplacianTexture() const { return laplacian_ ? laplacian_->id() : 0; }
  GLuint labelTexture() const { return labels_ ? labels_->id() : 0; }
  /// First voxel of the map, global index.
  glm::ivec3 mapOrigin() const { return macrocells_.origin(); }
  /// Own cells in which segments may show something; empty if the brick shows nothing. A segment
  /// reaches as far beyond the cell of its middle as there are ghost layers, at most.
  const IndexBox& visibleCells() const { return visibleCells_; }
  std::size_t residentBytes() const;

 private:
  std::vector<OctantMask> marksOf(std::span<const VisibleGroup> groups) const;

  BrickId id_;
  VolumeGrid grid_;
  IndexBox cells_;
  int ghostLayers_;
  BrickTexture texture_;
  std::optional<LaplacianTexture> laplacian_;
  std::optional<LabelTexture> labels_;
  Macrocells macrocells_;
  Texture map_;  ///< skip.glsl says what it holds
  IndexBox visibleCells_;
};

/// The voxels that a brick of these cells stores: [lo - ghost, hi + ghost] within the volume.
IndexBox storedVoxels(const IndexBox& cells, int ghostLayers, const VolumeGrid& grid);

}  // namespace burin::node
