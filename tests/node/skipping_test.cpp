// Skipping leaves the picture alone, bit for bit, and saves samples.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

/// A transfer function with random bumps and gaps over [0, 1].
TransferFunction randomTransferFunction(std::mt19937& random) {
  std::uniform_real_distribution<double> unit{0, 1};
  TransferFunction function;
  double value = unit(random) * 0.3;
  for (int i = 0; i < 6; ++i) {
    value += 0.02 + 0.15 * unit(random);
    const double opacity = unit(random) < 0.5 ? 0 : 0.6 * unit(random);
    const auto channel = [&] { return static_cast<std::uint8_t>(255 * unit(random)); };
    function.points.push_back({value, {channel(), channel(), channel()}, opacity});
  }
  function.points.front().opacity = 0;
  function.points.back().opacity = unit(random) < 0.5 ? 0 : 0.4;
  return function;
}

/// The same regions of value and gradient elsewhere, and others of them opaque.
TransferFunction randomWidgets(std::mt19937& random) {
  std::uniform_real_distribution<double> unit{0, 1};
  TransferFunction function = gentleWidgets();
  for (TransferWidget& widget : function.widgets) {
    widget.value = 0.9 * unit(random) + glm::dvec2{0, 0.02 + 0.2 * unit(random)};
    widget.opacity = unit(random) < 0.3 ? 0 : 0.9 * unit(random);
    if (widget.apex) widget.apex = widget.value.x + 0.1 * unit(random) - 0.05;
  }
  return function;
}

/// What decides a program: every style with each of these, so that few programs are compiled.
/// Whether there are several bricks decides, too: of one brick a style is drawn in two of the three
/// kinds, of four bricks in the third and one of those.
struct Kind {
  int layers;
  bool preintegrated;
  int clipPlanes;
};
constexpr std::array<Kind, 3> kKinds{{{1, true, 0}, {2, true, 1}, {1, false, 1}}};

std::array<Kind, 2> kindsOf(std::size_t styleNumber, int bricks) {
  const std::size_t first = styleNumber + (bricks == 1 ? 0 : 2);
  return {kKinds[first % 3], kKinds[(first + 1) % 3]};
}

/// Any values, seen from anywhere.
Scene randomScene(const std::string& style, const Kind& kind, std::mt19937& random) {
  std::uniform_real_distribution<double> unit{0, 1};
  Scene scene = sceneWithStyle(style);
  scene.imageSize = {48, 40};
  scene.layers.resize(static_cast<std::size_t>(kind.layers), scene.layers.front());
  for (Layer& layer : scene.layers)
    layer.transferFunction = layer.transferFunction.isTwoDimensional()
                                 ? randomWidgets(random)
                                 : randomTransferFunction(random);
  scene.quality.termination = unit(random) < 0.5 ? 0 : 0.002;
  scene.quality.preintegrated = kind.preintegrated;
  scene.quality.stepVoxels = 0.3 + 1.5 * unit(random);
  scene.camera.azimuthDeg = 360 * unit(random);
  scene.camera.elevationDeg = 180 * unit(random) - 90;
  scene.camera.zoom = 0.7 + unit(random);
  if (unit(random) < 0.3) scene.camera.projection = Projection::kOrthographic;
  for (int i = 0; i < kind.clipPlanes; ++i)
    scene.clip.push_back(
        {glm::normalize(glm::dvec3{unit(random), unit(random) - 0.5, unit(random)}),
         -12 * unit(random)});
  return scene;
}

// More than 200 scenes as edits of one another, of one brick and of four.
TEST(Skipping, OnEqualsOffBitForBit) {
  constexpr int kScenesOfEachKind = 6;
  const Communicator self{MPI_COMM_SELF};
  std::mt19937 random{7};
  int skippedSomething = 0;
  int scenes = 0;
  for (const int bricks : {1, 4}) {
    ArraySource source = smoothVolume(gridOf({17 + bricks, 34, 24}, {1, 1.3, 0.7}));
    const Scene first = resolved(sceneWithStyle("all"), source);
    node::WorkerOptions options{.bricks = bricks, .skip = true, .countSamples = true};
    node::Worker skipping{self, first, source, options};
    options.skip = false;
    node::Worker visiting{self, first, source, options};
    for (int round = bricks == 1 ? 0 : 1; round < kScenesOfEachKind; round += 2) {
      std::size_t styleNumber = 0;
      for (const std::string& style : drawnStyles()) {
        for (const Kind& kind : kindsOf(styleNumber++, bricks)) {
          const Scene scene = resolved(randomScene(style, kind, random), source);
          skipping.update(scene);
          visiting.update(scene);
          const Camera camera = resolveCamera(scene, {source.info().grid, false});
          RankStatistics on, off;
          const Image<Rgba> skipped = wholeFrame(skipping.draw(camera, on));
          const Image<Rgba> visited = wholeFrame(visiting.draw(camera, off));
          ASSERT_TRUE(std::ranges::equal(skipped.pixels(), visited.pixels())) << "scene " << scenes;
          EXPECT_EQ(on.samplesShaded, off.samplesShaded) << "scene " << scenes;
          EXPECT_LE(on.samplesVisited, off.samplesVisited) << "scene " << scenes;
          // Pre-integrated segments also count if they cross one and have their middle elsewhere.
          EXPECT_EQ(on.samplesInOccupiedCells, off.samplesInOccupiedCells) << "scene " << scenes;
          EXPECT_LE(on.samplesInOccupiedCells, on.samplesVisited) << "scene " << scenes;
          if (!kind.preintegrated) {
            EXPECT_EQ(on.samplesInOccupiedCells, on.samplesVisited) << "scene " << scenes;
          }
          EXPECT_EQ(off.leaps, 0) << "scene " << scenes;
          if (on.samplesVisited < off.samplesVisited) ++skippedSomething;
          ++scenes;
        }
      }
    }
  }
  EXPECT_GE(scenes, 200);
  EXPECT_GT(skippedSomething, scenes / 2);
}

// Eight bricks in a row, the first of which is enough: what is behind it is not looked at, and the
// picture changes by no more than the threshold.
TEST(Skipping, BricksBehindOpaqueOnesAreNotVisited) {
  ArraySource source{gridOf({17, 17, 129}), [](glm::ivec3) { return 0.5f; }};
  Scene scene = sceneWithStyle("plain");
  scene.layers[0].transferFunction = {{{0, {200, 90, 10}, 0.3}, {1, {200, 90, 10}, 0.3}}, {}};
  scene.camera = {.azimuthDeg = 0, .elevationDeg = 0, .projection = Projection::kOrthographic};
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const Image<Rgba> whole = drawAlone(scene, source, camera, {.bricks = 1});
  RankStatistics all;
  drawAlone(scene, source, camera, {.bricks = 8, .countSamples = true}, &all);
  scene.quality.termination = 0.002;
  RankStatistics alone, behind;
  drawAlone(scene, source, camera, {.bricks = 1, .countSamples = true}, &alone);
  const Image<Rgba> image =
      drawAlone(scene, source, camera, {.bricks = 8, .countSamples = true}, &behind);
  // One unit length takes 30 %: 0.7^18 < 0.002, so rays end within 19 of the 128 voxels.
  EXPECT_LE(behind.samplesVisited, all.samplesVisited * 19 / 128);
  EXPECT_EQ(behind.samplesVisited, alone.samplesVisited);
  EXPECT_LE(difference(whole, image).largest, scene.quality.termination);
}

/// A plane through the middle region of a volume, of any direction.
ClipPlane randomPlane(std::mt19937& random, const VolumeGrid& grid) {
  std::uniform_real_distribution<double> signedUnit{-1, 1};
  ClipPlane plane;
  plane.normal = {signedUnit(random), signedUnit(random), signedUnit(random)};
  const double height = 0.5 * signedUnit(random) * grid.boundingRadius();
  plane.offset = -glm::dot(plane.normal, grid.centreWorld()) - height * glm::length(plane.normal);
  return plane;
}

TEST(Skipping, ClippedCellsAreLeaptOverBitForBit) {
  std::mt19937 random{17};
  const std::vector<std::string> styles = drawnStyles();
  const Communicator self{MPI_COMM_SELF};
  for (int i = 0; i < 9; ++i) {
    // Everything shows but what is clipped, so that clipping alone saves samples.
    ArraySource source = smoothVolume(gridOf({30 + i, 41 - i, i == 3 ? 1 : 35}, {1, 1.3, 0.7}));
    Scene scene = sceneWithStyle(styles[static_cast<std::size_t>(i) % styles.size()]);
    for (TransferPoint& point : scene.layers[0].transferFunction.points)
      point.opacity = std::max(point.opacity, 0.01);
    scene.quality.stepVoxels = i % 5 == 0 ? 3 : 0.5;
    scene.quality.preintegrated = i % 2 == 0;
    if (i % 3 == 0) scene.camera.projection = Projection::kOrthographic;
    scene.camera.verticalFovDeg = i % 4 == 1 ? 120 : 30;
    scene.camera.azimuthDeg = 50 * i;
    scene = resolved(scene, source);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    const int bricks = 1 + i % 4;
    // The planes come and go as edits.
    node::Worker on{self, scene, source, {.bricks = bricks, .skip = true, .countSamples = true}};
    node::Worker off{self, scene, source, {.bricks = bricks, .skip = false, .countSamples = true}};
    for (int planes = 1; planes <= 3; ++planes) {
      scene.clip.push_back(randomPlane(random, source.info().grid));
      if (planes == 3) scene.clip.erase(scene.clip.begin());
      const glm::dvec3 centre = source.info().grid.centreWorld();
      if (planes == 2) scene.clipBox = ClipBox{centre - 7.0, centre + glm::dvec3{5.3, 11, 9}};
      on.update(scene);
      off.update(scene);
      RankStatistics counted, all;
      const Image<Rgba> skipped = wholeFrame(on.draw(camera, counted));
      const Image<Rgba> visited = wholeFrame(off.draw(camera, all));
      EXPECT_TRUE(std::ranges::equal(skipped.pixels(), visited.pixels())) << i << " " << planes;
      EXPECT_EQ(counted.samplesShaded, all.samplesShaded) << i << " " << planes;
    }
  }
}

TEST(Skipping, ClippedVolumeDrawsNothingAndAHalfHasItsFootprint) {
  ArraySource source{gridOf({41, 41, 41}), [](glm::ivec3) { return 0.5f; }};
  Scene scene = sceneWithStyle("plain");
  scene.layers[0].transferFunction = {{{0, {255, 255, 255}, 0.1}, {1, {255, 255, 255}, 0.1}}, {}};
  scene.camera = {.azimuthDeg = 0, .elevationDeg = 0, .projection = Projection::kOrthographic};
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const Communicator self{MPI_COMM_SELF};
  node::Worker worker{self, scene, source, {}};
  RankStatistics statistics;
  const int whole = worker.draw(camera, statistics).active.width();
  scene.clip = {{{2, 0, 0}, -2 * 24.0}};  // x >= 24 of 0 … 40: 16 cells and a macrocell's rounding
  worker.update(scene);
  const int part = worker.draw(camera, statistics).active.width();
  EXPECT_GE(part, whole * 16 / 40);
  EXPECT_LE(part, whole * 20 / 40 + 4);
  scene.clip = {{{0, 1, 0}, -41}};
  worker.update(scene);
  EXPECT_TRUE(worker.draw(camera, statistics).active.empty());
}

TEST(Skipping, SegmentsWhoseEndsAloneSeeSomethingAreDrawn) {
  // All that shows lies in the cells right of a split; long segments with their middle left of it
  // reach into them.
  for (const int edge : {20, 21, 22, 23, 24}) {
    ArraySource source{gridOf({41, 17, 17}),
                       [&](glm::ivec3 i) { return i.x > edge ? 1.0f : 0.0f; }};
    Scene scene = sceneWithStyle("plain");
    scene.layers[0].transferFunction = {{{0.5, {255, 0, 0}, 0}, {1, {255, 0, 0}, 0.3}}, {}};
    scene.quality.stepVoxels = 3.7;
    scene.camera.azimuthDeg = 90;
    scene = resolved(scene, source);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    const auto on = drawAlone(scene, source, camera, {.bricks = 4, .skip = true});
    const auto off = drawAlone(scene, source, camera, {.bricks = 4, .skip = false});
    EXPECT_TRUE(std::ranges::equal(on.pixels(), off.pixels())) << edge;
  }
}

TEST(Skipping, CountingDoesNotChangeThePicture) {
  ArraySource source = smoothVolume(gridOf({32, 32, 32}));
  const Scene scene = resolved(sceneWithStyle("all"), source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  RankStatistics counted;
  const Image<Rgba> plain = drawAlone(scene, source, camera);
  const Image<Rgba> withCounts = drawAlone(scene, source, camera, {.countSamples = true}, &counted);
  EXPECT_TRUE(std::ranges::equal(plain.pixels(), withCounts.pixels()));
  EXPECT_GT(counted.samplesShaded, 0);
}

/// Rays of a parallel view along z that meet a box of twice that many voxels a side.
std::int64_t raysThrough(const Camera& camera, double halfVoxels) {
  std::int64_t rays = 0;
  const double half = halfVoxels / camera.pixelSize;
  for (int y = 0; y < camera.image.height; ++y)
    for (int x = 0; x < camera.image.width; ++x)
      if (std::abs(x + 0.5 - 0.5 * camera.image.width) < half &&
          std::abs(y + 0.5 - 0.5 * camera.image.height) < half)
        ++rays;
  return rays;
}

TEST(Skipping, SamplesOfAHomogeneousBoxAreCountedOnce) {
  // A parallel view along z of an 11×11×11 box at step 1/2: every ray through the box meets 20 or
  // 21 segments; the count must not depend on the bricks.
  ArraySource source{gridOf({11, 11, 11}), [](glm::ivec3) { return 0.5f; }};
  Scene scene = sceneWithStyle("plain");
  scene.layers[0].transferFunction = {{{0, {255, 255, 255}, 0.01}, {1, {255, 255, 255}, 0.01}}, {}};
  scene.camera = {.azimuthDeg = 0, .elevationDeg = 0, .projection = Projection::kOrthographic};
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const std::int64_t rays = raysThrough(camera, 5);
  ASSERT_GT(rays, 100);
  for (const int bricks : {1, 2, 7, 30}) {
    RankStatistics statistics;
    drawAlone(scene, source, camera, {.bricks = bricks, .countSamples = true}, &statistics);
    EXPECT_GE(statistics.samplesVisited, 20 * rays);
    EXPECT_LE(statistics.samplesVisited, 21 * rays);
    EXPECT_EQ(statistics.samplesVisited, statistics.samplesShaded);
  }
}

TEST(Skipping, OfAMacrocellTheHalfThatShowsNothingIsLeaptOver) {
  // A sheet of voxels across a parallel view: what shows lies between voxels 16 and 18 along the
  // ray, one of the two octants of the macrocell from 16 to 20. With planes half a voxel apart 4
  // segments cover it, and at most 2 more touch its ends; 8 would cover the macrocell.
  ArraySource source{gridOf({11, 11, 33}), [](glm::ivec3 i) { return i.z == 17 ? 1.0f : 0.0f; }};
  Scene scene = sceneWithStyle("plain");
  // Beyond what widening and rounding take from the sheet's values: 2^-8, and a step of 3/225.
  scene.layers[0].transferFunction = {{{0.1, {255, 0, 0}, 0}, {1, {255, 0, 0}, 0.1}}, {}};
  scene.quality.preintegrated = true;
  scene.quality.stepVoxels = 0.5;
  scene.camera = {.azimuthDeg = 0, .elevationDeg = 0, .projection = Projection::kOrthographic};
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const std::int64_t rays = raysThrough(camera, 5);
  for (const int bricks : {1, 3}) {
    RankStatistics statistics;
    drawAlone(scene, source, camera, {.bricks = bricks, .countSamples = true}, &statistics);
    EXPECT_GE(statistics.samplesVisited, 4 * rays);
    EXPECT_LE(statistics.samplesVisited, 6 * rays);
    EXPECT_GE(statistics.samplesInOccupiedCells, 3 * rays);
    EXPECT_LE(statistics.samplesInOccupiedCells, 5 * rays);
  }
}

TEST(Skipping, VoxelsOfTheValueWhereAFunctionBeginsAreEmpty) {
  // A ball in zeros, opacity rising from 0 at 0: most of the box shows nothing.
  ArraySource source{gridOf({48, 48, 48}), [](glm::ivec3 i) {
                       const double r = glm::distance(glm::dvec3{i}, glm::dvec3{24});
                       return static_cast<float>(std::clamp(6 - r, 0.0, 1.0));
                     }};
  for (const bool preintegrated : {true, false}) {
    Scene scene = sceneWithStyle("plain");
    scene.layers[0].transferFunction = {{{0, {255, 0, 0}, 0}, {1, {255, 0, 0}, 0.5}}, {}};
    scene.quality.preintegrated = preintegrated;
    scene = resolved(scene, source);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    RankStatistics on, off;
    const auto skipped =
        drawAlone(scene, source, camera, {.countSamples = true, .wholeBricks = true}, &on);
    const auto visited = drawAlone(
        scene, source, camera, {.skip = false, .countSamples = true, .wholeBricks = true}, &off);
    EXPECT_TRUE(std::ranges::equal(skipped.pixels(), visited.pixels()));
    // The macrocells around the ball hold 20³ of the 47³ cells.
    EXPECT_LT(on.samplesVisited, off.samplesVisited / 5);
  }
}

TEST(Skipping, AnEmptySceneDrawsNothing) {
  ArraySource source = smoothVolume(gridOf({20, 20, 20}));
  Scene scene = sceneWithStyle("plain");
  scene.layers[0].transferFunction = {{{2, {255, 0, 0}, 0}, {3, {255, 0, 0}, 1}}, {}};
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const Communicator self{MPI_COMM_SELF};
  node::Worker worker{self, scene, source, {.bricks = 3}};
  RankStatistics statistics;
  EXPECT_TRUE(worker.draw(camera, statistics).active.empty());
}

}  // namespace
}  // namespace burin::test
