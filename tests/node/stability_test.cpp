// Extreme values: of data, of opacity, and none at all.

#include <limits>
#include <numbers>

#include "stability_fixture.hpp"

namespace burin::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

using StableValues = Stability;
using StableSpikes = Stability;  ///< with pre-integration alone: middles may miss them

TransferFunction mapped(TransferFunction function, double scale, double offset) {
  for (TransferPoint& point : function.points) point.value = point.value * scale + offset;
  return function;
}

TEST_P(StableValues, DataOfAnyScale) {
  for (const std::string style : {"plain", "all"}) {
    Image<Rgba> unscaled;
    for (const int exponent : {0, -20, -10, 10, 20}) {
      const double scale = std::pow(10.0, exponent);
      ArraySource source{gridOf({30, 26, 28}), [&](glm::ivec3 i) {
                           return static_cast<float>(scale * smoothField(glm::dvec3{i}));
                         }};
      Scene scene = sceneOf(style);
      scene.layers[0].transferFunction = mapped(gentleTransferFunction(), scale, 0);
      scene = resolved(scene, source);
      const std::string name = style + " times 1e" + std::to_string(exponent);
      const Image<Rgba> image =
          expectTrue(name, scene, source, cameraOf(scene, source), smoothBound(style));
      if (exponent == 0) unscaled = image;
      // Both are that close to the truth. Voxels, rounded after scaling, differ by less than what
      // smoothBound allows values.
      expectNear(name + " against 1", difference(image, unscaled), 2 * smoothBound(style));
    }
  }
}

TEST_P(StableValues, DataFarFromZero) {
  // An offset of 1e6 ranges leaves a float 16 values in the range: steps of 1/16 per voxel, which
  // is no more than the smooth field's own. Renderer and reference see the same voxels, and the
  // renderer stores them above the smallest: nothing else is lost.
  for (const std::string style : {"plain", "all"})
    for (const double offset : {1e6, -1e6}) {
      ArraySource source{gridOf({30, 26, 28}), [&](glm::ivec3 i) {
                           return static_cast<float>(offset + smoothField(glm::dvec3{i}));
                         }};
      Scene scene = sceneOf(style);
      scene.layers[0].transferFunction = mapped(gentleTransferFunction(), 1, offset);
      scene = resolved(scene, source);
      expectTrue(style + (offset > 0 ? " plus 1e6" : " minus 1e6"), scene, source,
                 cameraOf(scene, source), smoothBound(style));
    }
}

TransferFunction constantOpacity(double opacity, double unitLength) {
  return {{{0, {255, 255, 255}, opacity}, {1, {255, 255, 255}, opacity}}, unitLength};
}

TEST_P(StableValues, TenThousandFaintSteps) {
  // 1 - (1 - 1e-6)^10000, the design asks for 1e-4 relative. An addition to a sum near 0.01 rounds
  // by up to half its ulp of 2^-30, 5e-4 of what is added; but what is added falls by 1 %, which is
  // ten ulps, so the roundings run through all phases ten times and cancel but for a part of one.
  for (const bool ramp : {false, true}) {
    ArraySource source{gridOf({3, 3, 5001}), [&](glm::ivec3 i) {
                         return ramp ? static_cast<float>(i.z) / 5000.0f : 0.25f;
                       }};
    Scene scene = sceneOf("plain");
    scene.layers[0].transferFunction = constantOpacity(1e-6, 0.5);  // a step of half a voxel
    scene = resolved(scene, source);
    const Camera camera = axisCamera(2, false, source.info().grid, scene.imageSize, {0.5, 0.5, 0});
    const Rgba pixel = drawAlone(scene, source, camera).at(24, 20);
    const double expected = -std::expm1(10000 * std::log1p(-1e-6));
    std::printf("  %s: %.2g\n", ramp ? "ramp" : "constant", std::abs(pixel.a / expected - 1));
    EXPECT_NEAR(double{pixel.a} / expected, 1, 1e-4);
    EXPECT_NEAR(double{pixel.r} / expected, 1, 1e-4);
  }
}

constexpr float kRampPerVoxel = 1.0f / 32;

ArraySource rampAlongX() {
  return ArraySource{gridOf({33, 24, 24}),
                     [](glm::ivec3 i) { return kRampPerVoxel * static_cast<float>(i.x); }};
}

TEST_P(StableValues, OpaqueNextToEmpty) {
  ArraySource source = rampAlongX();
  const Colour a{255, 200, 20};
  const Colour b{25, 200, 220};
  const struct {
    const char* name;
    TransferFunction function;
  } cases[] = {{"up", {{{0.4, a, 0}, {0.4, a, 0.9999}}, {}}},
               {"down", {{{0.4, a, 0.9999}, {0.4, a, 0}}, {}}},
               {"up a little", {{{0.4, a, 0}, {0.4, a, 0.05}}, {}}},
               {"ramp", {{{0.399, a, 0}, {0.401, b, 0.9999}}, {}}},
               {"step first", {{{0.4, a, 0}, {0.4, a, 0.9999}, {0.9, a, 0}}, {}}},
               {"step last", {{{0.1, a, 0}, {0.4, a, 0.9999}, {0.4, a, 0}}, {}}},
               {"no grid", {{{0.3 / std::numbers::pi, a, 0}, {0.4, a, 0}, {0.4, b, 0.05}}, {}}}};
  for (const auto& c : cases) {
    Scene scene = sceneOf("plain");
    scene.layers[0].transferFunction = c.function;
    scene = resolved(scene, source);
    // No sample of these views (at quarters and eighths of a voxel) is within 1e-3 of the steep
    // piece, 12.8 voxels up the ramp. Values are off by 8u (smoothBound's v for this ramp), which
    // moves where pre-integrated rays cross by 32 * 8u voxels: 1.5e-4 of optical depth at
    // extinction 9.2, and nothing of the picture, as what follows is opaque; 1e-5 if faint.
    for (const int axis : {0, 1})
      expectTrue(std::string{c.name} + " along " + std::to_string(axis), scene, source,
                 axisCamera(axis, false, source.info().grid, scene.imageSize, {0.25, 0.25, 0}),
                 1e-5);
    // Oblique rays have samples anywhere: a middle in the steep piece may fall to either side. Pre-
    // integrated rays cross it 6e-5 voxels early or late at worst (the ramp along them rises by no
    // less than 1/128 per voxel), which is 6e-4 of opacity where no more than that lies behind:
    // only rays through the volume's edges, so the contract's bound stands.
    if (!GetParam()) continue;
    expectTrue(std::string{c.name} + " oblique", scene, source, cameraOf(scene, source));
  }
}

TEST_P(StableValues, SlowChangeFarFromTheStep) {
  // One voxel makes the range; all others change by a millionth of it or less per voxel, half the
  // range above a step. What is off is the chord alone, and colours and extinction are constant:
  // 6nu voxels of 0.05 extinction and the rounding of a hundred additions, both below 1e-5.
  for (const float change : {1e-3f, 1e-5f, 1e-6f})
    for (const double foot : {0.5, 0.45}) {
      ArraySource source{gridOf({24, 24, 24}), [&](glm::ivec3 i) {
                           if (i == glm::ivec3{0}) return 0.0f;
                           return 0.9f + change * static_cast<float>(i.x) / 23;
                         }};
      Scene scene = sceneOf("plain");
      scene.layers[0].transferFunction = {{{foot, {255, 200, 20}, 0}, {0.5, {255, 200, 20}, 0.05}},
                                          {}};
      scene = resolved(scene, source);
      expectTrue("change " + std::to_string(change) + " foot " + std::to_string(foot), scene,
                 source, cameraOf(scene, source), 1e-5);
    }
}

/// Points of triangles of opacity 0.9 around the centres, red at their peaks.
TransferFunction spikes(std::span<const double> centres, double halfWidth) {
  TransferFunction function;
  for (const double centre : centres) {
    function.points.push_back({centre - halfWidth, {0, 0, 255}, 0});
    function.points.push_back({centre, {255, 0, 0}, 0.9});
    function.points.push_back({centre + halfWidth, {0, 0, 255}, 0});
  }
  return function;
}

TEST_P(StableSpikes, CountInFull) {
  ArraySource source = rampAlongX();
  // The second centre has no common grid with the first.
  const double centres[] = {0.4, 0.3 + std::numbers::pi / 10};
  for (const double halfWidth : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6})
    for (const std::size_t count : {1u, 2u})
      for (const double step : {0.5, 1.0, 3.0, 7.3}) {
        Scene scene = sceneOf("plain");
        scene.quality.stepVoxels = step;
        TransferFunction function = spikes(std::span{centres}.first(count), halfWidth);
        // The optical depth of a spike is the integral of -ln(1 - o) over its values over the
        // ramp's rise: with peak o, 2 w ((1 - o) ln(1 - o) + o) / o. In these units it is 1.
        const double integral = 2 * halfWidth * (0.1 * std::log(0.1) + 0.9) / 0.9;
        function.opacityUnitLength = integral / double{kRampPerVoxel};
        scene.layers[0].transferFunction = function;
        const std::string name = std::to_string(count) + " of " + std::to_string(halfWidth) +
                                 " at step " + std::to_string(step);
        scene = resolved(scene, source);
        // Ends of segments hang together, so that integrals are lost nowhere; each is divided by
        // the difference of values over its segment, 1/64 or more, which is off by 4u: 1.5e-5 of
        // the depth, exp(-depth) depth <= 0.37 of that. Tables: another 1e-6 per unit length.
        const Image<Rgba> image = expectTrue(
            name, scene, source, axisCamera(0, false, source.info().grid, scene.imageSize), 1e-5);
        EXPECT_NEAR(double{image.at(24, 20).a}, -std::expm1(-static_cast<double>(count)), 1e-5)
            << name;
      }
}

TEST_P(StableValues, NoGradientsAnywhere) {
  // Directions do not exist, and the second light is where no half vector does. Colour and
  // extinction are constant, so only chords round: 6nu voxels times an extinction of 0.2.
  ArraySource source{gridOf({20, 20, 20}), [](glm::ivec3) { return 0.6f; }};
  for (const std::string& style : drawnStyles()) {
    Scene scene = sceneOf(style);
    for (StyleSettings& s : scene.layers[0].styles)
      if (s.name == "surface") s.values[0] = Curve{{{0, 0.7}, {1, 1}}};
    scene.lights = {{.direction = {0, 0, 1}}, {.direction = {0, 0, -1}}};
    scene.camera.projection = Projection::kOrthographic;
    scene = resolved(scene, source);
    expectTrue(style, scene, source, cameraOf(scene, source), 1e-5);
  }
}

TEST_P(StableValues, LightExactlyBehind) {
  // No half vector: light and eye are opposite.
  ArraySource source = smoothVolume(gridOf({30, 26, 28}));
  Scene scene = sceneOf("all");
  scene.lights = {{.direction = {0, 0, -1}}, {.direction = {0, 0, 1}}};
  scene.camera = {.azimuthDeg = 0, .elevationDeg = 0, .projection = Projection::kOrthographic};
  scene = resolved(scene, source);
  expectTrue("all", scene, source, cameraOf(scene, source), smoothBound("all"));
}

/// Against the z axis, rays a quarter of a voxel beside the voxels and samples at eighths: the
/// weight of valid voxels around a sample is an odd multiple of 1/128 or a coarser such fraction
/// where NaN voxels are single, in lines or in planes along the axes, so rounding takes none across
/// the 1/2 from which on a sample is valid.
Camera besideVoxels(const VolumeGrid& grid, ImageSize image) {
  return axisCamera(2, true, grid, image, {0.25, 0.25, 0.125});
}

TEST_P(StableValues, NanAndInfiniteVoxels) {
  const struct {
    const char* name;
    std::function<float(glm::ivec3)> special;  // 0: none
  } cases[] = {
      {"one NaN",
       [](glm::ivec3 i) {
         return i == glm::ivec3{9, 8, 10} ? kNan : 0;
       }},
      {"NaN line", [](glm::ivec3 i) { return i.x == 9 && i.y == 8 ? kNan : 0; }},
      {"NaN x planes", [](glm::ivec3 i) { return i.x == 5 || i.x == 11 || i.x == 12 ? kNan : 0; }},
      {"NaN z planes", [](glm::ivec3 i) { return i.z == 5 || i.z == 11 || i.z == 0 ? kNan : 0; }},
      {"NaN faces", [](glm::ivec3 i) { return i.x == 0 || i.x == 19 ? kNan : 0; }},
      {"one inf",
       [](glm::ivec3 i) {
         return i == glm::ivec3{9, 8, 10} ? kInfinity : 0;
       }},
      {"inf planes", [](glm::ivec3 i) { return i.x == 5   ? kInfinity
                                               : i.y == 7 ? -kInfinity
                                                          : 0; }},
      {"crossing planes",
       [](glm::ivec3 i) {
         return i.x == 5 ? kInfinity : i.z == 7 ? kNan : i.y == 4 ? -kInfinity : 0;
       }},
  };
  for (const auto& c : cases)
    for (const std::string style : {"plain", "all"}) {
      ArraySource source{gridOf({20, 20, 20}), [&](glm::ivec3 i) {
                           const float special = c.special(i);
                           return special != 0 ? special
                                               : static_cast<float>(smoothField(glm::dvec3{i}));
                         }};
      const Scene scene = resolved(sceneOf(style), source);
      // Beside infinities the field changes by up to its range per voxel, ten times what
      // smoothBound reckons with: 6e-5.
      for (const int bricks : {1, 3})
        expectTrue(std::string{c.name} + ", " + style, scene, source,
                   besideVoxels(source.info().grid, scene.imageSize), kReferenceBound,
                   {.bricks = bricks});
    }
}

TEST_P(StableValues, NothingButNan) {
  ArraySource source{gridOf({12, 12, 12}), [](glm::ivec3) { return kNan; }};
  for (const std::string style : {"plain", "all"}) {
    Scene scene = sceneOf(style);
    scene.layers[0].transferFunction = constantOpacity(0.5, 1);
    scene = resolved(scene, source);
    const DrawnAndTrue both = drawWithReference(scene, source, cameraOf(scene, source));
    EXPECT_EQ(largestAlpha(both.drawn), 0);
    expectNear(style, both.difference(), 0);
  }
}

TEST_P(StableValues, InfiniteVoxelsBesideAConstant) {
  // The finite range is one value, or none and then 0: infinities clamp to that. Values are exact
  // and only chords round, 6nu voxels of extinction 0.1.
  for (const float left : {0.6f, kInfinity, -kInfinity, kNan})
    for (const float right : {kInfinity, -kInfinity}) {
      ArraySource source{gridOf({12, 12, 12}),
                         [&](glm::ivec3 i) { return i.x > 5 ? left : right; }};
      Scene scene = sceneOf("plain");
      scene.layers[0].transferFunction = {{{-1, {255, 0, 0}, 0.2},
                                           {0, {0, 255, 0}, 0.05},
                                           {0.6, {0, 0, 255}, 0.1},
                                           {2, {255, 255, 255}, 0.5}},
                                          {}};
      scene = resolved(scene, source);
      expectTrue(std::to_string(left) + " and " + std::to_string(right), scene, source,
                 besideVoxels(source.info().grid, scene.imageSize), 1e-5);
    }
}

INSTANTIATE_TEST_SUITE_P(Classification, StableValues, testing::Bool(), classification);
INSTANTIATE_TEST_SUITE_P(Classification, StableSpikes, testing::Values(true), classification);

}  // namespace
}  // namespace burin::test
