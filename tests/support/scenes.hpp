#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "burin/common/scene.hpp"
#include "support/array_source.hpp"

namespace burin::test {

/// A smooth field in [0, 1], band-limited to about 16 voxels per period, no symmetry.
inline double smoothField(const glm::dvec3& p) {
  return 0.5 + 0.2 * std::sin(0.31 * p.x + 0.2) * std::cos(0.27 * p.y) +
         0.2 * std::sin(0.35 * p.z + 0.11 * p.x) + 0.1 * std::cos(0.2 * (p.x + p.y - p.z));
}

inline VolumeGrid gridOf(const glm::ivec3& dims, const glm::dvec3& spacing = glm::dvec3{1}) {
  VolumeGrid grid;
  grid.dims = dims;
  grid.spacing = spacing;
  return grid;
}

inline ArraySource smoothVolume(const VolumeGrid& grid) {
  return ArraySource{grid,
                     [](glm::ivec3 i) { return static_cast<float>(smoothField(glm::dvec3{i})); }};
}

/// A translucent transfer function over [0, 1], no steeper than full opacity over 1/16 of the
/// range; `scale` scales the opacities.
inline TransferFunction gentleTransferFunction(double scale = 1) {
  return {{{0.35, {20, 60, 200}, 0},
           {0.5, {240, 200, 40}, 0.15 * scale},
           {0.65, {230, 60, 30}, 0.02 * scale},
           {0.9, {255, 250, 240}, 0.5 * scale}},
          std::nullopt};
}

/// One layer, that style alone (none for "plain"), at 72×56 pixels, no termination.
inline Scene sceneWithStyle(const std::string& style) {
  Scene scene;
  scene.volume.procedural = "homogeneous";  // the source is given separately
  scene.imageSize = {72, 56};
  scene.quality = {.stepVoxels = 0.5, .termination = 0};
  Layer layer;
  layer.name = style;
  layer.transferFunction = gentleTransferFunction();
  if (style == "all") {
    for (const StyleSpec& spec : styleTable()) layer.styles.push_back(defaultSettings(spec));
  } else if (style != "plain") {
    layer.styles.push_back(defaultSettings(*findStyle(style)));
  }
  scene.layers.push_back(layer);
  return scene;
}

/// Every style that draws, "plain" and "all".
inline std::vector<std::string> drawnStyles() {
  std::vector<std::string> names{"plain", "all"};
  for (const StyleSpec& spec : styleTable())
    if (spec.hasSnippet) names.emplace_back(spec.name);
  return names;
}

}  // namespace burin::test
