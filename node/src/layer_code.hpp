#pragma once

#include <optional>
#include <string>

#include "burin/common/scene.hpp"

namespace burin::node {

/// The passes that a layer takes in the slices technique (Lum & Ma, Figure 10).
enum class LayerPass {
  kColour,  ///< pass I: the transfer function's colour and extinction under all styles but lines
  kLines,   ///< pass II: the styles that draw lines
};

/// GLSL that classifies and shades a sample or segment under all layers of a scene: all passes in
/// one, or one of them.
std::string layerCode(const Scene& scene, std::optional<LayerPass> pass);

}  // namespace burin::node
