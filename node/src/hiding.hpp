#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burin/common/camera.hpp"
#include "burin/common/geometry.hpp"
#include "clip_planes.hpp"

namespace burin::node {

/// Blocks that rays go through.
struct RayBlocks {
  CubeGrid cubes;
  std::span<const float> extinction;     ///< mean of each, per world unit; x fastest
  std::span<const std::uint32_t> brick;  ///< that each belongs to
};

/// Share of a view's rays through each block that are not opaque yet when they come to it, by what
/// the same brick has in front of it: bricks of other ranks are drawn at the same time and hide
/// nothing from it. Found from `across`² rays; 1 where none of them comes. A ray ends when its
/// transmittance is below `termination` (> 0).
std::vector<float> shareNotHidden(const Camera& view, const VolumeGrid& grid,
                                  const RayBlocks& blocks, double termination, int across);

}  // namespace burin::node
