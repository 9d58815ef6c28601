#pragma once

#include <span>
#include <vector>

#include "gl.hpp"
#include "value_scale.hpp"

namespace burin::node {

/// Limits a brick must stay below; llvmpipe's, so that every rank splits alike without asking.
inline constexpr int kLargestTextureExtent = 2048;
inline constexpr std::size_t kLargestTextureBytes = std::size_t{1} << 30;

/// Bytes of one texel: R16 for integers, R32F for floats, RG32F for floats with NaN voxels.
std::size_t bytesPerTexel(VoxelType type, bool hasInvalid);

/// A linearly filtered texture with clamped edges and no content yet. Fails as GL does: see
/// checkGl().
Texture makeLinearTexture(GLenum format, const glm::ivec3& size);

/// Room for one slab on its way into a texture; one serves all bricks of a rank while they load.
struct StagingBuffer {
  std::vector<std::uint16_t> texels16;
  std::vector<float> texels32;
  std::vector<float> values;  ///< stored values in [0, 1], NaN where not valid
};

/// The voxels of one brick, ghosts included, as a linearly filtered texture with clamped edges.
class BrickTexture {
 public:
  /// Its OffscreenContext must be current, here and later.
  BrickTexture(const IndexBox& storedVoxels, VoxelType type, const ValueScale& scale);

  /// Uploads the voxels of `box` (inside the stored box), native order, x fastest. Leaves their
  /// stored values in `staging.values`.
  void upload(const IndexBox& box, std::span<const std::byte> voxels, StagingBuffer& staging);

  GLuint id() const { return texture_.id(); }
  const IndexBox& storedVoxels() const { return stored_; }
  std::size_t bytes() const;

 private:
  IndexBox stored_;
  VoxelType type_;
  ValueScale scale_;
  Texture texture_;
};

}  // namespace burin::node
