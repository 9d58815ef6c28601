// Skipping leaves the picture alone, bit for bit, and saves samples.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(Skipping, OnEqualsOffBitForBit) {
  std::mt19937 random{7};
  const std::vector<std::string> styles = drawnStyles();
  int skippedSomething = 0;
  for (int i = 0; i < 24; ++i) {
    ArraySource source = smoothVolume(gridOf({30 + i, 50 - i, 41}, {1, 1.3, 0.7}));
    Scene scene = sceneWithStyle(styles[static_cast<std::size_t>(i) % styles.size()]);
    scene.layers[0].transferFunction = randomTransferFunction(random);
    scene.quality.termination = i % 2 == 0 ? 0 : 0.002;
    scene.camera.azimuthDeg = 40 * i;
    scene.camera.elevationDeg = 10 * (i % 9) - 40;
    if (i % 3 == 0) scene.camera.projection = Projection::kOrthographic;
    scene = resolved(scene, source);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    const int bricks = 1 + i % 4;
    RankStatistics on, off;
    const Image<Rgba> skipped = drawAlone(
        scene, source, camera, {.bricks = bricks, .skip = true, .countSamples = true}, &on);
    const Image<Rgba> visited = drawAlone(
        scene, source, camera, {.bricks = bricks, .skip = false, .countSamples = true}, &off);
    EXPECT_TRUE(std::ranges::equal(skipped.pixels(), visited.pixels())) << "scene " << i;
    EXPECT_EQ(on.samplesShaded, off.samplesShaded) << "scene " << i;
    EXPECT_LE(on.samplesVisited, off.samplesVisited) << "scene " << i;
    EXPECT_EQ(on.samplesInOccupiedCells, on.samplesVisited) << "scene " << i;
    EXPECT_EQ(off.leaps, 0) << "scene " << i;
    if (on.samplesVisited < off.samplesVisited) ++skippedSomething;
  }
  EXPECT_GT(skippedSomething, 12);
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

TEST(Skipping, SamplesOfAHomogeneousBoxAreCountedOnce) {
  // A parallel view along z of an 11×11×11 box at step 1/2: every ray through the box meets 20 or
  // 21 segments; the count must not depend on the bricks.
  ArraySource source{gridOf({11, 11, 11}), [](glm::ivec3) { return 0.5f; }};
  Scene scene = sceneWithStyle("plain");
  scene.layers[0].transferFunction = {{{0, {255, 255, 255}, 0.01}, {1, {255, 255, 255}, 0.01}}, {}};
  scene.camera = {.azimuthDeg = 0, .elevationDeg = 0, .projection = Projection::kOrthographic};
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  std::int64_t rays = 0;
  const double half = 5 / camera.pixelSize;
  for (int y = 0; y < camera.image.height; ++y)
    for (int x = 0; x < camera.image.width; ++x)
      if (std::abs(x + 0.5 - 0.5 * camera.image.width) < half &&
          std::abs(y + 0.5 - 0.5 * camera.image.height) < half)
        ++rays;
  ASSERT_GT(rays, 100);
  for (const int bricks : {1, 2, 7, 30}) {
    RankStatistics statistics;
    drawAlone(scene, source, camera, {.bricks = bricks, .countSamples = true}, &statistics);
    EXPECT_GE(statistics.samplesVisited, 20 * rays);
    EXPECT_LE(statistics.samplesVisited, 21 * rays);
    EXPECT_EQ(statistics.samplesVisited, statistics.samplesShaded);
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
    const auto skipped = drawAlone(scene, source, camera, {.countSamples = true}, &on);
    const auto visited =
        drawAlone(scene, source, camera, {.skip = false, .countSamples = true}, &off);
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
