#pragma once

#include "brick_texture.hpp"
#include "smoothed_laplacian.hpp"

namespace burin::node {

/// The smoothed Laplacian at a brick's stored voxels, over the volume's 99.9th percentile of its
/// magnitude, as a linearly filtered R32F texture that has the coordinates of the brick's. 0 at
/// voxels with a NaN within kLaplacianReach.
class LaplacianTexture {
 public:
  /// `laplacian999`: the percentile, per squared world unit. Its OffscreenContext must be current,
  /// here and later.
  LaplacianTexture(const IndexBox& storedVoxels, const VolumeGrid& grid, const ValueScale& scale,
                   double laplacian999);

  /// The stored values of whole slices, in ascending z, all of the box in the end.
  void add(std::span<const float> values);

  GLuint id() const { return texture_.id(); }
  std::size_t bytes() const { return size_.count() * sizeof(float); }

 private:
  void upload(int z, std::span<const float> laplacian);

  IndexBox size_;  ///< from 0
  SmoothedLaplacian filter_;
  float factor_;  ///< to what the texture holds
  std::vector<float> texels_;
  Texture texture_;
};

}  // namespace burin::node
