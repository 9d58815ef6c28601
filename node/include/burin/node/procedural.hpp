#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string_view>

#include "burin/node/brick_source.hpp"

namespace burin::node {

/// A volume with a closed form. `value(p)` is defined on the unit cube: p = index / (dims - 1) per
/// axis (½ for an axis of one voxel); its range is [0, 1]. Integer types store
/// round(value * largest) with largest 255 (u8), 4095 (u16), and -1024 + value * 4095 (i16, like
/// Hounsfield units); f32 stores the value itself.
struct ProceduralKind {
  std::string_view name;
  std::string_view help;  ///< one line
  double (*value)(const glm::dvec3& p);
  bool isLabels = false;  ///< a segmentation: label / 255, of type u8 only
  /// A body in its file's frame: x to its left, y up, z to its front. Others say nothing of where
  /// they are.
  bool isAnatomical = false;
};

/// marschner-lobb, shells, homogeneous, ramp, vessels, ct-phantom, ct-phantom-labels.
std::span<const ProceduralKind> proceduralKinds();

/// Throws Error{kUsage} naming the nearest kind if `name` is unknown.
std::unique_ptr<BrickSource> makeProcedural(std::string_view name, const glm::ivec3& dims,
                                            VoxelType type, const glm::dvec3& spacing);

}  // namespace burin::node
