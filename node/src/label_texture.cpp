#include "label_texture.hpp"

#include <array>

namespace burin::node {

std::size_t bytesPerLabelTexel(std::size_t masks) {
  return masks > 8 ? 2 : 1;
}

LabelTexture::LabelTexture(const IndexBox& storedVoxels, const CubeGrid& macrocells,
                           std::size_t masks, int reach)
    : stored_{storedVoxels},
      isWide_{bytesPerLabelTexel(masks) == 2},
      texture_{makeTexture(GL_TEXTURE_3D)},
      occurring_{macrocells, reach} {
  const glm::ivec3 size = stored_.size();
  gl().TextureStorage3D(texture_.id(), 1, isWide_ ? GL_R16UI : GL_R8UI, size.x, size.y, size.z);
  for (const GLenum axis :
       std::array<GLenum, 3>{GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    gl().TextureParameteri(texture_.id(), axis, GL_CLAMP_TO_EDGE);
  gl().TextureParameteri(texture_.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl().TextureParameteri(texture_.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  checkGl("making a texture of labels");
}

void LabelTexture::upload(const IndexBox& box, std::span<const MaskBits> masks) {
  occurring_.add(box, masks);
  const void* texels = masks.data();
  if (!isWide_) {
    narrow_.assign(masks.begin(), masks.end());
    texels = narrow_.data();
  }
  const glm::ivec3 at = box.lo - stored_.lo;
  const glm::ivec3 size = box.size();
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl().TextureSubImage3D(texture_.id(), 0, at.x, at.y, at.z, size.x, size.y, size.z, GL_RED_INTEGER,
                         isWide_ ? GL_UNSIGNED_SHORT : GL_UNSIGNED_BYTE, texels);
  checkGl("uploading labels");
}

std::size_t LabelTexture::bytes() const {
  return stored_.count() * (isWide_ ? 2u : 1u) + occurring_.bytes();
}

}  // namespace burin::node
