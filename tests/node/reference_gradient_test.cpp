// Gradients: direction, orientation, world units, border, and what counts as magnitude 1.
#include <gtest/gtest.h>

#include "node/reference_ramp.hpp"

namespace burin::test {
namespace {

/// Shows the normal as colour n/2 + 1/2 …
StyleSettings showNormal() {
  return makeStyle("light", {{"ambient", 1.0}, {"diffuse", 0.0}, {"normal_color", 1.0}});
}

/// … and the magnitude m as the factor on the extinction.
StyleSettings showMagnitude() {
  return makeStyle("surface", {{"opacity", Curve{{{0, 0}, {1, 1}}}}});
}

TEST(ReferenceGradient, NormalOrientation) {
  RampProbe probe;
  const glm::dvec3 uphill = glm::dvec3{1, 2, 0} / std::sqrt(5.0);
  const auto shown = [&](const char* orientation) {
    const auto gradient = makeStyle("gradient", {{"normal", std::string{orientation}}});
    return 2.0 * probe.measure({gradient, showNormal()}).colour - 1.0;
  };
  expectNear(shown("outward"), -uphill);
  expectNear(shown("inward"), uphill);
  expectNear(shown("facing"), uphill);  // the eye lies towards (3,2,9)
  expectNear(2.0 * probe.measure({showNormal()}).colour - 1.0, -uphill);
  probe.camera.forward = -probe.camera.forward;
  expectNear(shown("outward"), -uphill);
  expectNear(shown("facing"), -uphill);
}

TEST(ReferenceGradient, IsInWorldUnits) {
  RampProbe probe;
  probe.grid.spacing = {2, 0.5, 1};  // world slope (1/2, 4, 0)
  probe.camera =
      makeCamera(Projection::kOrthographic, probe.grid.centreWorld() + glm::dvec3{3, 2, 9},
                 probe.grid.centreWorld(), 1, {1, 1});
  probe.gradientScale = 8;
  const Classified sample = probe.measure({showMagnitude(), showNormal()});
  EXPECT_NEAR(sample.extinction, std::sqrt(0.25 + 16) / 8, kProbeRounding);
  expectNear(2.0 * sample.colour - 1.0, -glm::normalize(glm::dvec3{0.5, 4, 0}));
}

TEST(ReferenceGradient, OfAShearedGridIsPerpendicularToItsLevels) {
  RampProbe probe;
  probe.grid.spacing = {1, 2, 0.7};
  probe.grid.direction = {glm::dvec3{1, 0, 0}, glm::dvec3{0.4, 0.9, 0.1},
                          glm::dvec3{0.2, -0.3, 0.9}};
  probe.camera =
      makeCamera(Projection::kOrthographic, probe.grid.centreWorld() + glm::dvec3{3, 2, 9},
                 probe.grid.centreWorld(), 1, {1, 1});
  probe.slopeIndex = {1, 0, 0};
  probe.gradientScale = 5;
  // Levels of f = i are spanned by the other two axes; f rises by 1 over the first axis' vector.
  const glm::dvec3 across =
      glm::normalize(glm::cross(probe.grid.direction[1], probe.grid.direction[2]));
  const double slope = 1 / glm::dot(across, probe.grid.direction[0]);
  const Classified sample = probe.measure({showMagnitude(), showNormal()});
  expectNear(2.0 * sample.colour - 1.0, -across);
  EXPECT_NEAR(sample.extinction, slope / 5, kProbeRounding);
}

/// Magnitude times scale (as extinction over the transfer function's) at index (x, y) of a volume
/// that does not depend on z, seen along z, away from its z border.
double magnitudeAt(const VolumeGrid& grid, const std::function<float(glm::ivec3)>& field,
                   const glm::dvec2& index, const char* unit, std::optional<double> scale) {
  ArraySource source{grid, field};
  Scene scene = makeScene(
      {makeLayer(constantTransfer({255, 255, 255}, 0.3),
                 {makeStyle("gradient", {{"magnitude", std::string{unit}}}), showMagnitude()})},
      0.5);
  const glm::dvec3 target = grid.worldFromIndex({index, grid.centreIndex().z});
  scene.clip = {{.normal = {0, 0, 1}, .offset = -(target.z - 0.25)},
                {.normal = {0, 0, -1}, .offset = target.z + 0.25}};
  const Camera camera =
      makeCamera(Projection::kOrthographic, target + glm::dvec3{0, 0, 50}, target, 1, {1, 1});
  const double depth = opticalDepth(draw(scene, source, camera, scale).front());
  return depth / (0.5 * -std::log(0.7));
}

TEST(ReferenceGradient, OfAQuadraticIsLinearBetweenVoxels) {
  const auto square = [](glm::ivec3 at) { return static_cast<float>(at.x * at.x); };
  const VolumeGrid grid = makeGrid({9, 5, 5});
  for (const double x : {2.0, 2.3, 5.75})
    EXPECT_NEAR(magnitudeAt(grid, square, {x, 2}, "percentile", 20.0), 2 * x / 20, kProbeRounding);
}

TEST(ReferenceGradient, TapsAreClampedAtTheBorder) {
  const auto ramp = [](glm::ivec3 at) { return static_cast<float>(at.x); };
  const VolumeGrid grid = makeGrid({9, 5, 5});
  // Taps at 0 and x + 1, at x - 1 and 8.
  EXPECT_NEAR(magnitudeAt(grid, ramp, {0.25, 2}, "percentile", 2.0), 1.25 / 4, kProbeRounding);
  EXPECT_NEAR(magnitudeAt(grid, ramp, {7.5, 2}, "percentile", 2.0), 1.5 / 4, kProbeRounding);
  EXPECT_NEAR(magnitudeAt(grid, ramp, {4.5, 2}, "percentile", 2.0), 0.5, kProbeRounding);
}

TEST(ReferenceGradient, AxisOfOneVoxelContributesNothing) {
  const auto ramp = [](glm::ivec3 at) { return static_cast<float>(at.x + 7 * at.y); };
  EXPECT_NEAR(magnitudeAt(makeGrid({9, 1, 5}), ramp, {4.5, 0.3}, "percentile", 2.0), 0.5,
              kProbeRounding);
  EXPECT_NEAR(magnitudeAt(makeGrid({9, 5, 1}), ramp, {4.5, 2}, "percentile", 20.0),
              std::sqrt(50.0) / 20, kProbeRounding);
}

TEST(ReferenceGradient, MagnitudeIsClampedToOne) {
  RampProbe probe;
  probe.gradientScale = 1;  // |∇f| is √5
  const auto surface = makeStyle("surface", {{"opacity", Curve{{{0, 0}, {1, 0.5}, {2, 1}}}}});
  EXPECT_NEAR(probe.measure({surface}).extinction, 0.5, kProbeRounding);
}

/// A ramp of slope 1/8 with one voxel 100 higher. Of its 20³ voxels six see half of that in their
/// differences: fewer than one in a thousand, so they do not count for the percentile.
float rampWithSpike(glm::ivec3 at) {
  return static_cast<float>(at.x) / 8 + (at == glm::ivec3{5, 5, 5} ? 100.0f : 0.0f);
}

TEST(ReferenceGradientScale, PercentileIgnoresASpike) {
  const VolumeGrid grid = makeGrid({20, 20, 20});
  EXPECT_NEAR(magnitudeAt(grid, rampWithSpike, {14, 14}, "percentile", std::nullopt), 1,
              kProbeRounding);
  // At the border the difference is halved, and so is m.
  EXPECT_NEAR(magnitudeAt(grid, rampWithSpike, {0, 14}, "percentile", std::nullopt), 0.5,
              kProbeRounding);
}

TEST(ReferenceGradientScale, MaximumSeesTheSpikeAndIgnoresTheGivenPercentile) {
  const VolumeGrid grid = makeGrid({20, 20, 20});
  // Its neighbour along x rises by (100 + 2/8)/2.
  for (const std::optional<double> given : {std::optional<double>{}, std::optional{3.0}})
    EXPECT_NEAR(magnitudeAt(grid, rampWithSpike, {14, 14}, "maximum", given), 0.125 / 50.125,
                kProbeRounding);
}

TEST(ReferenceGradientScale, PercentileIsTheSmallestNotExceededByMoreThanOneInAThousand) {
  // 4000 voxels in a row with f = i²/2: |∇f| = i inside (1 … 3998), 1/4 and 1999.5 - 1/4 … at the
  // ends. The magnitudes in order: 0.25, 1, 2, …, 1999, 1999.75, 2000, …, 3998; number ⌈0.999 ·
  // 4000⌉ = 3996 has 4 above it, 3995 … 3998: it is 3994.
  const VolumeGrid grid = makeGrid({4000, 1, 1});
  const auto parabola = [](glm::ivec3 at) {
    return static_cast<float>(at.x) * static_cast<float>(at.x) / 2;
  };
  // f reaches 8e6 < 2^23, in halves: exact in float.
  EXPECT_NEAR(magnitudeAt(grid, parabola, {100, 0}, "percentile", std::nullopt), 100.0 / 3994,
              kProbeRounding);
}

/// A ball of denser material: bright on the lit side, dark lines where it turns away from the eye.
class ReferenceBall : public testing::Test {
 protected:
  static constexpr int kSide = 41;

  glm::dvec4 pixel(const std::vector<StyleSettings>& styles, int column, int row) const {
    const VolumeGrid grid = makeGrid({24, 24, 24});
    ArraySource source{grid, [](glm::ivec3 at) {
                         const double r = glm::length(glm::dvec3{at} - 11.5);
                         return static_cast<float>(1 / (1 + std::exp(1.5 * (r - 8))));
                       }};
    Scene scene = makeScene({makeLayer(TransferFunction{.points = {{0.3, {255, 255, 255}, 0},
                                                                   {0.6, {255, 255, 255}, 0.99}},
                                                        .opacityUnitLength = 1.0},
                                       styles)},
                            0.5);
    scene.lights = {{.direction = {1, 0, 0.3}, .eyeSpace = true}};
    const Camera camera =
        makeCamera(Projection::kOrthographic, grid.centreWorld() + glm::dvec3{10, 6, 30},
                   grid.centreWorld(), 0.5, {kSide, kSide});
    const auto pixels = node::ReferenceRenderer{scene, source}.render(camera, row, row + 1, 1);
    return pixels.at(static_cast<std::size_t>(column));
  }

  /// Straight (not premultiplied) green at `offset` pixels to the right of the centre.
  double brightness(const std::vector<StyleSettings>& styles, int offset) const {
    const glm::dvec4 p = pixel(styles, kSide / 2 + offset, kSide / 2);
    EXPECT_GT(p.a, 0.3);
    return p.g / p.a;
  }
};

TEST_F(ReferenceBall, IsBrightOnTheLitSide) {
  const std::vector<StyleSettings> outward{makeStyle("light")};
  EXPECT_GT(brightness(outward, 12), 0.9);
  EXPECT_NEAR(brightness(outward, -12), 0.3, 0.02);  // ambient alone
  const std::vector<StyleSettings> inward{
      makeStyle("gradient", {{"normal", std::string{"inward"}}}), makeStyle("light")};
  EXPECT_NEAR(brightness(inward, 12), 0.3, 0.02);
  EXPECT_GT(brightness(inward, -12), 0.6);
}

TEST_F(ReferenceBall, IsWarmOnTheLitSide) {
  const std::vector<StyleSettings> tone{makeStyle("tone")};
  const glm::dvec4 lit = pixel(tone, kSide / 2 + 12, kSide / 2);
  const glm::dvec4 dark = pixel(tone, kSide / 2 - 12, kSide / 2);
  EXPECT_GT(lit.r, 1.2 * lit.b);
  EXPECT_GT(dark.b, 1.2 * dark.r);
}

TEST_F(ReferenceBall, HasDarkEdgesAtItsSilhouette) {
  const std::vector<StyleSettings> edges{makeStyle("edges")};
  EXPECT_NEAR(brightness(edges, 0), 1, 1e-3);
  for (const int sign : {-1, 1}) {
    EXPECT_GT(brightness(edges, 8 * sign), 0.95);
    EXPECT_LT(brightness(edges, 16 * sign), 0.5);
  }
}

}  // namespace
}  // namespace burin::test
