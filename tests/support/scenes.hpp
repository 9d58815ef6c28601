#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "burin/common/error.hpp"
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

/// A two-dimensional one over [0, 1], one region of each shape, each overlapping the others.
inline TransferFunction gentleWidgets() {
  TransferFunction function;
  function.widgets = {{.shape = WidgetShape::kTriangle,
                       .value = {0.3, 0.8},
                       .gradient = {0.05, 1},
                       .apex = 0.5,
                       .gradientFalloff = 0.5,
                       .colour = {20, 60, 200},
                       .opacity = 0.3},
                      {.shape = WidgetShape::kRectangle,
                       .value = {0.55, 1.1},
                       .gradient = {0, 0.7},
                       .valueFalloff = 0.5,
                       .colour = {230, 60, 30},
                       .opacity = 0.25},
                      {.shape = WidgetShape::kEllipse,
                       .value = {0, 0.6},
                       .gradient = {0.1, 1.3},
                       .colour = {240, 200, 40},
                       .opacity = 0.2}};
  return function;
}

/// Opacities for lines: most where gentleTransferFunction() shows nothing, and gaps where it does.
inline std::vector<OpacityPoint> gentleLineOpacity() {
  return {{0.1, 0}, {0.25, 0.3}, {0.4, 0.05}, {0.5, 0}, {0.6, 0}, {0.8, 0.2}};
}

/// The gradient settings with that operator.
inline StyleSettings gradientBy(const std::string& gradientOperator) {
  StyleSettings settings = defaultSettings(*findStyle("gradient"));
  settings.values.front() = gradientOperator;  // the table's first parameter
  return settings;
}

/// One layer, that style alone (none for "plain"; of "line_opacity", which is a layer's own, and
/// "line_surface" with lines; of a gradient operator's name: light and edges by it; of "widgets", a
/// transfer function of these and edges), at 72×56 pixels, no termination.
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
  } else if (style == "line_opacity") {
    layer.lineOpacity = gentleLineOpacity();
    for (const char* lines : {"edges", "specular"})
      layer.styles.push_back(defaultSettings(*findStyle(lines)));
  } else if (style == "widgets") {
    layer.transferFunction = gentleWidgets();
    layer.styles.push_back(defaultSettings(*findStyle("edges")));
  } else if (style == "line_surface") {
    for (const char* lines : {"edges", "line_surface"})
      layer.styles.push_back(defaultSettings(*findStyle(lines)));
  } else if (style == "sobel" || style == "regression") {
    layer.styles = {gradientBy(style), defaultSettings(*findStyle("light")),
                    defaultSettings(*findStyle("edges"))};
  } else if (style != "plain") {
    layer.styles.push_back(defaultSettings(*findStyle(style)));
  }
  // By default they leave nearly nothing away from surfaces: tests want something to see.
  for (StyleSettings& settings : layer.styles)
    if (settings.name == "boundary" || settings.name == "silhouette")
      settings.values.front() = 0.5;  // the table's first parameter: "constant"
  scene.layers.push_back(layer);
  return scene;
}

/// Every style that draws, "plain", "all", "line_opacity", the gradient operators that are no
/// default, and "widgets".
inline std::vector<std::string> drawnStyles() {
  std::vector<std::string> names{"plain", "all", "line_opacity"};
  for (const StyleSpec& spec : styleTable())
    if (spec.hasSnippet) names.emplace_back(spec.name);
  names.insert(names.end(), {"sobel", "regression", "widgets"});
  return names;
}

/// Sets of styles, such that of any two styles there are sets with both, with none, and with either
/// one alone.
inline constexpr unsigned kStyleSets = 12;

/// One layer with set number `set` of kStyleSets. The words of parameters go round from set to set.
inline Scene sceneWithStyleSet(unsigned set) {
  // Styles differ in a bit of their numbers, and each bit has a set and one with all others.
  const auto isIn = [&](unsigned number) {
    if (set < 2) return set == 0;
    return ((number >> (set / 2 - 1)) & 1u) == set % 2;
  };
  Scene scene = sceneWithStyle("plain");
  Layer& layer = scene.layers.front();
  unsigned number = 0;
  for (const StyleSpec& spec : styleTable()) {
    if (!isIn(number++)) continue;
    StyleSettings settings = defaultSettings(spec);
    for (std::size_t i = 0; i < spec.parameters.size(); ++i) {
      const auto& choices = spec.parameters[i].choices;
      if (!choices.empty()) settings.values[i] = std::string{choices[(set + i) % choices.size()]};
    }
    layer.styles.push_back(std::move(settings));
  }
  if (isIn(number++)) layer.lineOpacity = gentleLineOpacity();
  BURIN_CHECK(number <= 1u << (kStyleSets / 2 - 1));  // else a pair differs in no bit
  return scene;
}

}  // namespace burin::test
