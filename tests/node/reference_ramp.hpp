#pragma once

#include <gtest/gtest.h>

#include "node/reference_fixture.hpp"

namespace burin::test {

/// What one ray through a linear field says about a style. The field's gradient is constant and the
/// transfer function too, so every sample has the same colour and extinction: both can be read off
/// the pixel exactly. Clip planes keep the samples away from the border, where central differences
/// are one-sided.
struct RampProbe {
  VolumeGrid grid = makeGrid({12, 12, 12});
  glm::dvec3 slopeIndex{1, 2, 0};  ///< of the field, per index unit
  Camera camera = makeCamera(Projection::kOrthographic, grid.centreWorld() + glm::dvec3{3, 2, 9},
                             grid.centreWorld(), 1, {1, 1});
  TransferFunction transfer = constantTransfer({200, 150, 90}, 0.3);
  std::vector<OpacityPoint> lineOpacity;
  double gradientScale = 4;
  std::vector<Light> lights = {
      {.direction = {-1, -2, 2}, .eyeSpace = false, .colour = {255, 200, 150}, .intensity = 0.8},
      {.direction = {0, -3, 1}, .eyeSpace = false, .colour = {100, 150, 255}, .intensity = 0.5}};

  glm::dvec3 colour() const { return transfer.points[0].colour.linear(); }

  /// Colour, and extinction as a multiple of the transfer function's, of pixel `at`.
  Classified measure(std::vector<StyleSettings> styles, std::size_t at = 0) const {
    Scene scene = makeScene({makeLayer(transfer)}, 0.5);
    scene.lights = lights;
    for (int axis = 0; axis < 3; ++axis) {
      // Normals of the index axes' planes, so that a sheared grid is clipped to indices 2 … 9 too.
      glm::dvec3 unit{0};
      unit[axis] = 1;
      const glm::dvec3 normal = glm::transpose(grid.worldToIndex()) * unit;
      const double zero = -glm::dot(normal, grid.origin);
      scene.clip.push_back({.normal = normal, .offset = zero - 2, .hasCap = false});
      scene.clip.push_back({.normal = -normal, .offset = 9 - zero, .hasCap = false});
    }
    ArraySource source{grid, [this](glm::ivec3 index) {
                         return static_cast<float>(glm::dot(slopeIndex, glm::dvec3{index}));
                       }};
    const glm::dvec4 plain = draw(scene, source, camera, gradientScale).at(at);
    BURIN_CHECK(plain.a > 0.1);
    scene.layers[0].styles = std::move(styles);
    scene.layers[0].lineOpacity = lineOpacity;
    const glm::dvec4 styled = draw(scene, source, camera, gradientScale).at(at);
    return {rgb(styled) / styled.a, opticalDepth(styled) / opticalDepth(plain)};
  }
};

/// Colours and ratios come from sums of some thirty samples, each rounded a few dozen times.
inline constexpr double kProbeRounding = 1e-12;

inline void expectNear(const glm::dvec3& value, const glm::dvec3& expected) {
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(value[c], expected[c], kProbeRounding) << "component " << c;
}

}  // namespace burin::test
