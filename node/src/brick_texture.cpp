#include "brick_texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

struct TexelFormat {
  GLenum internal, external, component;
};

TexelFormat formatOf(VoxelType type, bool hasInvalid) {
  if (type != VoxelType::kF32) return {GL_R16, GL_RED, GL_UNSIGNED_SHORT};
  if (hasInvalid) return {GL_RG32F, GL_RG, GL_FLOAT};
  return {GL_R32F, GL_RED, GL_FLOAT};
}

/// Voxels of a type from bytes of any alignment.
template <typename Voxel, typename Convert>
void convert(std::span<const std::byte> bytes, std::vector<std::uint16_t>& texels,
             Convert texelOf) {
  texels.resize(bytes.size() / sizeof(Voxel));
  for (std::size_t i = 0; i < texels.size(); ++i) {
    Voxel voxel;
    std::memcpy(&voxel, bytes.data() + i * sizeof(Voxel), sizeof(Voxel));
    texels[i] = texelOf(voxel);
  }
}

/// Stored value of a float voxel; infinities clamp to the ends of the finite range.
float storedFloat(float voxel, const ValueScale& scale) {
  if (std::isnan(voxel)) return voxel;
  return static_cast<float>(std::clamp(scale.stored(double{voxel}), 0.0, scale.largestStored));
}

/// Fills the staging buffer with a slab's values and texels; returns the texels.
const void* stageFloats(std::span<const std::byte> voxels, const ValueScale& scale,
                        StagingBuffer& staging) {
  std::vector<float>& values = staging.values;
  values.resize(voxels.size() / sizeof(float));
  for (std::size_t i = 0; i < values.size(); ++i) {
    float voxel;
    std::memcpy(&voxel, voxels.data() + i * sizeof(float), sizeof(float));
    values[i] = storedFloat(voxel, scale);
  }
  if (!scale.hasInvalid) return values.data();
  staging.texels32.resize(2 * values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool valid = !std::isnan(values[i]);
    staging.texels32[2 * i] = valid ? values[i] : 0.0f;
    staging.texels32[2 * i + 1] = valid ? 1.0f : 0.0f;
  }
  return staging.texels32.data();
}

const void* stageIntegers(std::span<const std::byte> voxels, VoxelType type,
                          const ValueScale& scale, StagingBuffer& staging) {
  std::vector<std::uint16_t>& texels = staging.texels16;
  const auto lowest = static_cast<int>(scale.lowest);
  const auto aboveLowest = [lowest](int voxel) {
    return static_cast<std::uint16_t>(voxel - lowest);
  };
  if (type == VoxelType::kU8)
    convert<std::uint8_t>(voxels, texels,
                          [](std::uint8_t v) { return static_cast<std::uint16_t>(v * 257); });
  else if (type == VoxelType::kI16)
    convert<std::int16_t>(voxels, texels, aboveLowest);
  else
    convert<std::uint16_t>(voxels, texels, aboveLowest);
  constexpr float kUnit = 1.0f / 65535.0f;
  staging.values.resize(texels.size());
  for (std::size_t i = 0; i < texels.size(); ++i)
    staging.values[i] = static_cast<float>(texels[i]) * kUnit;
  return texels.data();
}

}  // namespace

std::size_t bytesPerTexel(VoxelType type, bool hasInvalid) {
  if (type != VoxelType::kF32) return 2;
  return hasInvalid ? 8 : 4;
}

Texture makeLinearTexture(GLenum format, const glm::ivec3& size) {
  Texture texture = makeTexture(GL_TEXTURE_3D);
  gl().TextureStorage3D(texture.id(), 1, format, size.x, size.y, size.z);
  for (const GLenum axis :
       std::array<GLenum, 3>{GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    gl().TextureParameteri(texture.id(), axis, GL_CLAMP_TO_EDGE);
  gl().TextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl().TextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

BrickTexture::BrickTexture(const IndexBox& storedVoxels, VoxelType type, const ValueScale& scale)
    : stored_{storedVoxels},
      type_{type},
      scale_{scale},
      texture_{makeLinearTexture(formatOf(type_, scale_.hasInvalid).internal, stored_.size())} {
  const glm::ivec3 size = stored_.size();
  if (const GLenum error = gl().GetError(); error != GL_NO_ERROR)
    fail(ExitCode::kRank, "no memory for a brick of {}x{}x{} voxels ({} MiB as a texture)", size.x,
         size.y, size.z, bytes() >> 20);
}

void BrickTexture::upload(const IndexBox& box, std::span<const std::byte> voxels,
                          StagingBuffer& staging) {
  BURIN_CHECK_EQ(voxels.size(), box.count() * bytesPerVoxel(type_));
  const void* texels = type_ == VoxelType::kF32 ? stageFloats(voxels, scale_, staging)
                                                : stageIntegers(voxels, type_, scale_, staging);
  const glm::ivec3 at = box.lo - stored_.lo;
  const glm::ivec3 size = box.size();
  const TexelFormat format = formatOf(type_, scale_.hasInvalid);
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl().TextureSubImage3D(texture_.id(), 0, at.x, at.y, at.z, size.x, size.y, size.z,
                         format.external, format.component, texels);
  checkGl("uploading voxels");
}

std::size_t BrickTexture::bytes() const {
  return stored_.count() * bytesPerTexel(type_, scale_.hasInvalid);
}

}  // namespace burin::node
