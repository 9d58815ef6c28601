#include "laplacian_texture.hpp"

#include <cmath>

#include "burin/common/error.hpp"

namespace burin::node {

LaplacianTexture::LaplacianTexture(const IndexBox& storedVoxels, const VolumeGrid& grid,
                                   const ValueScale& scale, double laplacian999)
    : size_{glm::ivec3{0}, storedVoxels.size()},
      filter_{storedVoxels.size(), grid},
      factor_{laplacian999 > 0 ? static_cast<float>(scale.range * filter_.unit() / laplacian999)
                               : 0.0f},
      texture_{makeLinearTexture(GL_R32F, storedVoxels.size())} {
  checkGl("making a texture of the Laplacian");
}

void LaplacianTexture::add(std::span<const float> values) {
  const auto sliceSize =
      static_cast<std::size_t>(size_.size().x) * static_cast<std::size_t>(size_.size().y);
  BURIN_CHECK_EQ(values.size() % sliceSize, 0u);
  for (; !values.empty(); values = values.subspan(sliceSize))
    filter_.add(values.first(sliceSize),
                [this](int z, std::span<const float> laplacian) { upload(z, laplacian); });
}

void LaplacianTexture::upload(int z, std::span<const float> laplacian) {
  texels_.resize(laplacian.size());
  for (std::size_t i = 0; i < texels_.size(); ++i)
    texels_[i] = std::isfinite(laplacian[i]) ? factor_ * laplacian[i] : 0.0f;
  const glm::ivec3 extent = size_.size();
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl().TextureSubImage3D(texture_.id(), 0, 0, 0, z, extent.x, extent.y, 1, GL_RED, GL_FLOAT,
                         texels_.data());
  checkGl("uploading the Laplacian");
}

}  // namespace burin::node
