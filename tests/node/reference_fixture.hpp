#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "burin/common/error.hpp"
#include "burin/common/scene.hpp"
#include "burin/node/reference.hpp"
#include "support/array_source.hpp"

namespace burin::test {

inline VolumeGrid makeGrid(const glm::ivec3& dims, const glm::dvec3& spacing = glm::dvec3{1}) {
  return {.dims = dims, .origin = {-3, 5, 11}, .spacing = spacing, .direction = glm::dmat3{1}};
}

inline ArraySource homogeneous(const VolumeGrid& grid) {
  return {grid, [](glm::ivec3) { return 1.0f; }};
}

/// The same colour and opacity (per world unit) for every value.
inline TransferFunction constantTransfer(const Colour& colour, double opacity) {
  return {.points = {{0, colour, opacity}, {1, colour, opacity}}, .opacityUnitLength = 1.0};
}

inline StyleSettings makeStyle(
    std::string_view name,
    std::initializer_list<std::pair<std::string_view, ParameterValue>> values = {}) {
  const StyleSpec* spec = findStyle(name);
  BURIN_CHECK(spec != nullptr);
  StyleSettings settings = defaultSettings(*spec);
  for (const auto& [parameter, value] : values) {
    std::size_t i = 0;
    while (spec->parameters.at(i).name != parameter) ++i;
    settings.values[i] = value;
  }
  return settings;
}

inline Layer makeLayer(TransferFunction transfer, std::vector<StyleSettings> styles = {}) {
  return {.name = "layer", .transferFunction = std::move(transfer), .styles = std::move(styles)};
}

/// A scene with early ray termination off.
inline Scene makeScene(std::vector<Layer> layers, double stepVoxels) {
  Scene scene;
  scene.layers = std::move(layers);
  scene.quality = {.stepVoxels = stepVoxels, .termination = 0};
  return scene;
}

/// A camera at `eye` with `target` in the middle of the picture.
inline Camera makeCamera(Projection projection, const glm::dvec3& eye, const glm::dvec3& target,
                         double pixelSize, ImageSize image) {
  const glm::dvec3 forward = glm::normalize(target - eye);
  const glm::dvec3 helper = std::abs(forward.y) < 0.9 ? glm::dvec3{0, 1, 0} : glm::dvec3{1, 0, 0};
  const glm::dvec3 right = glm::normalize(glm::cross(forward, helper));
  return {.projection = projection,
          .eyeWorld = eye,
          .right = right,
          .up = glm::cross(right, forward),
          .forward = forward,
          .pixelSize = pixelSize,
          .image = image};
}

inline std::vector<glm::dvec4> draw(const Scene& scene, node::BrickSource& source,
                                    const Camera& camera,
                                    std::optional<double> gradientScale = std::nullopt) {
  node::ReferenceScales scales;
  scales.gradients.fill(gradientScale);
  return node::ReferenceRenderer{scene, source, scales}.render(camera, 0, camera.image.height, 2);
}

inline glm::dvec3 rgb(const glm::dvec4& pixel) {
  return {pixel.r, pixel.g, pixel.b};
}

/// Optical depth of a pixel: the extinction's integral along its ray.
inline double opticalDepth(const glm::dvec4& pixel) {
  return -std::log1p(-pixel.a);
}

/// Largest difference of any channel of any pixel.
inline double largestDifference(const std::vector<glm::dvec4>& a,
                                const std::vector<glm::dvec4>& b) {
  BURIN_CHECK_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 4; ++c) largest = std::max(largest, std::abs(a[i][c] - b[i][c]));
  return largest;
}

/// Largest opacity of any pixel: that a comparison does not compare nothing.
inline double largestOpacity(const std::vector<glm::dvec4>& pixels) {
  double largest = 0;
  for (const glm::dvec4& pixel : pixels) largest = std::max(largest, pixel.a);
  return largest;
}

}  // namespace burin::test
