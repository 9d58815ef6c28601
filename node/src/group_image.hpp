#pragma once

#include <span>

#include "burin/common/scene.hpp"
#include "burin/node/group_image.hpp"
#include "value_scale.hpp"

namespace burin::node {

/// The finished frame: projections classified by their transfer functions, in double, as colours
/// with the opacities as they are written; each image over those of the groups before. One image
/// for each of `groups`, all of one size.
Image<Rgba> mergeGroups(std::span<const Scene> groups, std::span<const GroupImage> images,
                        const ValueScale& scale);

}  // namespace burin::node
