// The slices technique: the fused program's samples, added up in a framebuffer.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "burin/common/error.hpp"
#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

using node::Precision;
using node::Technique;
using node::WorkerOptions;

WorkerOptions slices(WorkerOptions options = {}, Precision precision = Precision::kFloat) {
  options.technique = Technique::kSlices;
  options.precision = precision;
  return options;
}

/// Two layers with both passes each, both visible at many samples.
Scene twoLayers() {
  Scene scene = sceneWithStyle("all");
  Layer second = sceneWithStyle("edges").layers[0];
  second.name = "second";
  second.transferFunction.points = {{0.3, {40, 220, 90}, 0}, {0.7, {250, 40, 200}, 0.3}};
  scene.layers.push_back(second);
  return scene;
}

/// A scene by name, small, in one of two views that have little in common.
Scene sceneNamed(const std::string& name, int view) {
  Scene scene = name == "layers" ? twoLayers() : sceneWithStyle(name);
  scene.imageSize = {56, 44};
  scene.camera = {.azimuthDeg = 35.0 + 100 * view, .elevationDeg = 25};
  if (view == 1) {
    scene.camera.projection = Projection::kOrthographic;
    scene.clip = {{{1, 0.3, 0.2}, -20}, {{0, 0, -1}, 45}};
    scene.quality.preintegrated = false;
  }
  return scene;
}

std::vector<std::string> sceneNames() {
  std::vector<std::string> names = drawnStyles();
  names.emplace_back("layers");
  return names;
}

VolumeGrid smallGrid() {
  return gridOf({40, 33, 25}, {1.0, 0.8, 1.9});
}

class Slices : public testing::TestWithParam<std::string> {};

// Positions, segments and look-ups are the same expressions on the same numbers. What differs is
// the order in which at most 250 samples are added up, each rounded a few times: 250 * 4 * 2^-24 =
// 6e-5.
TEST_P(Slices, AgreeWithTheFusedProgram) {
  ArraySource source = smoothVolume(smallGrid());
  for (const int view : {0, 1}) {
    const Scene scene = resolved(sceneNamed(GetParam(), view), source);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    const Image<Rgba> fused = drawAlone(scene, source, camera, {.bricks = 3});
    const Difference d = difference(fused, drawAlone(scene, source, camera, slices({.bricks = 3})));
    EXPECT_GT(largestAlpha(fused), 0.3) << view;
    EXPECT_TRUE(d.finite);
    EXPECT_LE(d.largest, 1e-4) << "view " << view;
  }
}

// As brick_invariance_test.cpp, whose bounds these are: bricks blend slice by slice into one frame.
TEST_P(Slices, AnyNumberOfBricksDrawsTheSamePicture) {
  ArraySource source = smoothVolume(smallGrid());
  const Scene scene = resolved(sceneNamed(GetParam(), 0), source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const Image<Rgba> one = drawAlone(scene, source, camera, slices({.bricks = 1}));
  const Difference d = difference(one, drawAlone(scene, source, camera, slices({.bricks = 13})));
  EXPECT_GT(largestAlpha(one), 0.3);
  EXPECT_LE(d.largest, 5e-5);
  EXPECT_LE(d.rms, 2e-6);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Slices, testing::ValuesIn(sceneNames()),
                         [](const auto& scene) { return scene.param; });

TEST(Slices, AgreeWithTheFusedProgramInsideTheVolumeAndAcrossNanVoxels) {
  const VolumeGrid grid = gridOf({30, 30, 30});
  ArraySource source{grid, [](glm::ivec3 i) {
                       const bool hole = glm::distance(glm::dvec3{i}, glm::dvec3{17, 14, 12}) < 6;
                       return hole ? std::numeric_limits<float>::quiet_NaN()
                                   : static_cast<float>(smoothField(glm::dvec3{i}));
                     }};
  for (const bool preintegrated : {true, false}) {
    Scene scene = sceneWithStyle("all");
    scene.quality.preintegrated = preintegrated;
    scene.camera = {.verticalFovDeg = 90};
    scene.camera.eye = grid.centreWorld() + glm::dvec3{2.1, -1.7, 0.9};
    scene.camera.target = grid.centreWorld() + glm::dvec3{10, 14, 6};
    scene = resolved(scene, source);
    const Camera camera = resolveCamera(scene, {grid, false});
    const Image<Rgba> fused = drawAlone(scene, source, camera);
    EXPECT_GT(largestAlpha(fused), 0.3);
    EXPECT_LE(difference(fused, drawAlone(scene, source, camera, slices({.bricks = 2}))).largest,
              1e-4);
  }
}

TEST(Slices, SkippingChangesNothingBitForBit) {
  std::mt19937 random{11};
  std::uniform_real_distribution<double> unit{0, 1};
  const std::vector<std::string> names = sceneNames();
  bool skippedSomething = false;
  for (int i = 0; i < 10; ++i) {
    ArraySource source = smoothVolume(gridOf({24 + i, 40 - i, 31}, {1, 1.3, 0.7}));
    Scene scene = sceneNamed(names[static_cast<std::size_t>(i) % names.size()], i % 2);
    scene.quality.stepVoxels = 0.5 + 0.5 * (i % 4);
    scene.camera.azimuthDeg = 40 * i;
    const double low = 0.4 + 0.3 * unit(random);
    for (Layer& layer : scene.layers)
      layer.transferFunction.points = {{low, {250, 180, 90}, 0},
                                       {low + 0.05, {90, 180, 250}, 0.8 * unit(random)},
                                       {low + 0.1 + 0.2 * unit(random), {9, 250, 20}, 0}};
    scene = resolved(scene, source);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    RankStatistics on, off;
    const auto draw = [&](bool skip, RankStatistics& statistics) {
      return drawAlone(scene, source, camera,
                       slices({.bricks = 1 + i % 3, .skip = skip, .countSamples = true}),
                       &statistics);
    };
    const Image<Rgba> skipped = draw(true, on);
    EXPECT_TRUE(std::ranges::equal(skipped.pixels(), draw(false, off).pixels())) << "scene " << i;
    EXPECT_EQ(on.samplesShaded, off.samplesShaded) << "scene " << i;
    EXPECT_EQ(on.samplesInOccupiedCells, off.samplesInOccupiedCells) << "scene " << i;
    EXPECT_LE(on.samplesInOccupiedCells, on.samplesVisited) << "scene " << i;
    EXPECT_EQ(off.leaps, 0) << "scene " << i;
    skippedSomething = skippedSomething || on.samplesVisited < off.samplesVisited / 2;
  }
  EXPECT_TRUE(skippedSomething);
}

// Every draw looks its samples up by itself, and each of them visits what rays visit that never
// end. The ends of runs of occupied cells are found from another segment on and may round
// otherwise.
TEST(Slices, EveryPassVisitsTheSamplesOfTheRays) {
  ArraySource source = smoothVolume(smallGrid());
  struct Case {
    const char* name;
    int draws;
  };
  for (const Case& c : {Case{"plain", 1}, Case{"edges", 2}, Case{"layers", 4}})
    for (const bool skip : {true, false}) {
      const Scene scene = resolved(sceneNamed(c.name, 0), source);
      const Camera camera = resolveCamera(scene, {source.info().grid, false});
      const WorkerOptions options{.bricks = 2, .skip = skip, .countSamples = true};
      RankStatistics rays, sliced;
      drawAlone(scene, source, camera, options, &rays);
      drawAlone(scene, source, camera, slices(options), &sliced);
      EXPECT_GT(rays.samplesVisited, 10'000);
      EXPECT_NEAR(static_cast<double>(sliced.samplesVisited),
                  static_cast<double>(c.draws * rays.samplesVisited),
                  1e-3 * static_cast<double>(c.draws * rays.samplesVisited))
          << c.name << " " << skip;
    }
}

/// A homogeneous box seen along z in parallel, all of whose rays through the box are alike.
struct Slab {
  ArraySource source;
  Scene scene;
  Camera camera;

  Slab(int cells, double stepVoxels, std::vector<TransferFunction> layers)
      : source{gridOf({9, 9, cells + 1}), [](glm::ivec3) { return 0.5f; }} {
    for (const TransferFunction& function : layers) {
      Layer layer;
      layer.transferFunction = function;
      scene.layers.push_back(layer);
    }
    scene.volume.procedural = "homogeneous";
    scene.imageSize = {32, 32};
    scene.quality = {.stepVoxels = stepVoxels, .termination = 0};
    scene.camera = {
        .azimuthDeg = 0, .elevationDeg = 0, .zoom = 3, .projection = Projection::kOrthographic};
    scene = resolved(scene, source);
    camera = resolveCamera(scene, {source.info().grid, false});
  }

  /// Lengths of a ray's segments in voxels, front to back: lattice planes are multiples of the step
  /// from the eye.
  std::vector<double> segments() const {
    const double centre =
        glm::dot(source.info().grid.centreWorld() - camera.eyeWorld, camera.forward);
    const double half = 0.5 * (source.info().grid.dims.z - 1);
    const double step = scene.quality.stepVoxels;
    std::vector<double> lengths;
    for (double at = centre - half; at < centre + half;) {
      const double plane = std::min((std::floor(at / step + 1e-9) + 1) * step, centre + half);
      lengths.push_back(plane - at);
      at = plane;
    }
    return lengths;
  }

  Rgba centrePixel(Precision precision = Precision::kFloat) {
    return drawAlone(scene, source, camera, slices({}, precision)).at(16, 16);
  }
};

TransferFunction everywhere(Colour colour, double opacity) {
  return {{{0, colour, opacity}, {1, colour, opacity}}, {}};
}

/// 8-bit arithmetic with rounding to nearest, as blending does it.
double inBytes(double x) {
  return std::round(255 * x) / 255;
}

TEST(Slices, ByteFramebuffersLoseFaintAccumulations) {
  // 136 cells at step 1/2 of 0.0019 per segment, less than half of 1/255: nothing is left of what
  // adds up to 0.4.
  Slab faint{136, 0.5, {everywhere({255, 255, 255}, 1 - std::pow(1 - 0.0019, 2))}};
  const double right = 1 - std::pow(1 - 0.0019, 2 * 136);
  ASSERT_GT(right, 0.4);
  // 272 samples, each rounded four times.
  EXPECT_NEAR(double{faint.centrePixel().a}, right, 272 * 4 * 0x1p-24);
  EXPECT_EQ(faint.centrePixel(Precision::kByte).a, 0);
  // A half has 11 bits: every blend rounds by at most 2^-12 below 1/2, which a faint sample feels.
  const double half = faint.centrePixel(Precision::kHalf).a;
  EXPECT_NEAR(half, right, 272 * 0x1p-12);
  EXPECT_GT(std::abs(half - right), 1e-3);
}

// The source of a blend is rounded to 8 bits, and so is the product with what lies behind: the
// framebuffer does what arithmetic in 1/255 does, give or take a unit where a half is rounded.
TEST(Slices, ByteFramebuffersBlendInMultiplesOf255ths) {
  Slab slab{24, 1, {everywhere({255, 255, 255}, 0.06)}};
  double expected = 0;
  for (const double length : slab.segments()) {
    const double opacity = inBytes(1 - std::pow(1 - 0.06, length));
    expected = opacity + inBytes(expected * (1 - opacity));
  }
  EXPECT_NEAR(double{slab.centrePixel(Precision::kByte).a}, expected, 1.01 / 255);
  EXPECT_NEAR(double{slab.centrePixel().a}, 1 - std::pow(1 - 0.06, 24), 24 * 4 * 0x1p-24);
}

// With errors that earlier blends left shrinking by 1 - opacity, n blends add up at most n
// roundings: of the source's colour, of its opacity times what is behind, and of the product (byte:
// half of 1/255 each), or of the sum (half: 2^-11 up to 1, as it may be cut off).
TEST(Slices, LowPrecisionIsOffByItsRoundings) {
  ArraySource source = smoothVolume(smallGrid());
  Scene scene = sceneNamed("layers", 0);
  scene.quality.stepVoxels = 2;
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const double blends =
      std::ceil(2 * source.info().grid.boundingRadius() /
                (scene.quality.stepVoxels * source.info().grid.smallestSpacing()));
  const Image<Rgba> exact = drawAlone(scene, source, camera, slices());
  const double half =
      difference(exact, drawAlone(scene, source, camera, slices({}, Precision::kHalf))).largest;
  const double byte =
      difference(exact, drawAlone(scene, source, camera, slices({}, Precision::kByte))).largest;
  EXPECT_LE(half, blends * 0x1p-11);
  EXPECT_LE(byte, blends * 1.5 / 255);
  EXPECT_GT(half, 0x1p-13);  // else it was drawn in float
  EXPECT_GT(byte, 2 * half);
}

// White under black material, both of opacity 0.9 per voxel: simultaneous media are 50 % grey at
// any step; black drawn over white at each sample leaves of white what depends on the step.
TEST(Slices, OverChangesWithTheStepAndSumDoesNot) {
  for (const double step : {2.0, 1.0, 0.5, 0.25}) {
    Slab slab{12, step, {everywhere({255, 255, 255}, 0.9), everywhere({0, 0, 0}, 0.9)}};
    EXPECT_NEAR(slab.centrePixel().r, 0.5, 1e-5) << step;
    slab.scene.quality.combine = Combine::kOver;
    double white = 0;
    double transmittance = 1;
    for (const double length : slab.segments()) {
      const double behindBlack = std::pow(0.1, length);
      white += transmittance * behindBlack * (1 - behindBlack);
      transmittance *= behindBlack * behindBlack;
    }
    EXPECT_NEAR(slab.centrePixel().r, white, 1e-5) << step;
    EXPECT_NEAR(slab.centrePixel().a, 1, 1e-5) << step;
  }
}

TEST(Slices, OverIsSumWhereNothingMeetsAtASample) {
  ArraySource source = smoothVolume(smallGrid());
  Scene scene = resolved(sceneNamed("light", 0), source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const Image<Rgba> sum = drawAlone(scene, source, camera, slices());
  scene.quality.combine = Combine::kOver;
  EXPECT_TRUE(
      std::ranges::equal(sum.pixels(), drawAlone(scene, source, camera, slices()).pixels()));
}

/// What the scene is refused with; fails if it is drawn.
std::string refusal(const Scene& scene, node::BrickSource& source, const WorkerOptions& options) {
  try {
    const Communicator self{MPI_COMM_SELF};
    const node::Worker worker{self, scene, source, options};
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    return error.what();
  }
  ADD_FAILURE() << "was drawn";
  return {};
}

TEST(Slices, WhatATechniqueCannotDrawIsRefused) {
  ArraySource source = smoothVolume(gridOf({12, 12, 12}));
  Scene over = resolved(sceneWithStyle("plain"), source);
  over.quality.combine = Combine::kOver;
  EXPECT_THAT(refusal(over, source, {}), testing::HasSubstr("drawn by slices only"));
  Scene quantised = resolved(sceneWithStyle("plain"), source);
  quantised.quality.normals = Normals::kQuantised;
  EXPECT_THAT(refusal(quantised, source, {}), testing::HasSubstr("quality.normals"));
  Scene paletted = resolved(sceneWithStyle("plain"), source);
  paletted.quality.palettes = Palettes::kBefore;
  paletted.quality.preintegrated = false;
  EXPECT_THAT(refusal(paletted, source, {}), testing::HasSubstr("quality.palettes"));
  paletted.layers = sceneWithStyle("widgets").layers;
  EXPECT_THAT(refusal(paletted, source, {.technique = Technique::kSlices}),
              testing::HasSubstr("two-dimensional"));
  const Scene plain = resolved(sceneWithStyle("plain"), source);
  EXPECT_THAT(refusal(plain, source, {.precision = Precision::kByte}),
              testing::HasSubstr("precision byte"));
  Scene bounded = plain;
  bounded.quality.maxError = 0.01;
  EXPECT_THAT(refusal(bounded, source, slices({}, Precision::kHalf)),
              testing::HasSubstr("precision half"));
  EXPECT_THAT(refusal(bounded, source, slices({})), testing::HasSubstr("each ray"));
}

}  // namespace
}  // namespace burin::test
