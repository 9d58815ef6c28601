#pragma once

#include <variant>

#include "burin/common/image.hpp"
#include "burin/compositor/largest_value.hpp"
#include "burin/compositor/weighted_sum.hpp"

namespace burin::node {

/// The whole frame of one of a scene's layerGroups(), all ranks' parts merged: premultiplied linear
/// RGBA of media and surfaces; of a projection the values as textures hold them.
using GroupImage = std::variant<Image<Rgba>, Image<compositor::LargestValuePixel>,
                                Image<compositor::WeightedSumPixel>>;

}  // namespace burin::node
