#pragma once

#include <span>
#include <vector>

#include "gl.hpp"
#include "label_masks.hpp"
#include "sets_of_cubes.hpp"

namespace burin::node {

/// Which masks the stored voxels of a brick belong to, as an unfiltered texture with clamped edges
/// that has the coordinates of the brick's (one byte a voxel, two for more than eight masks), and
/// which occur in each of its macrocells.
class LabelTexture {
 public:
  /// `reach`: as of SetsOfCubes. Its OffscreenContext must be current, here and later. Fails as GL
  /// does.
  LabelTexture(const IndexBox& storedVoxels, const CubeGrid& macrocells, std::size_t masks,
               int reach);

  /// The masks of the voxels of `box` (inside the stored box), x fastest.
  void upload(const IndexBox& box, std::span<const MaskBits> masks);

  GLuint id() const { return texture_.id(); }
  /// Per macrocell.
  const std::vector<MaskBits>& occurring() const { return occurring_.sets(); }
  std::size_t bytes() const;

 private:
  IndexBox stored_;
  bool isWide_;
  Texture texture_;
  SetsOfCubes<MaskBits> occurring_;
  std::vector<std::uint8_t> narrow_;
};

/// Bytes that a voxel of one takes.
std::size_t bytesPerLabelTexel(std::size_t masks);

}  // namespace burin::node
