// A worker that was told to draw another scene draws what a new one would, bit for bit.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

/// One random change of those a user makes.
void edit(Scene& scene, std::mt19937& random) {
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  TransferFunction& function = scene.layers[0].transferFunction;
  switch (pick(7)) {
    case 0:
      function.points[static_cast<std::size_t>(pick(4))].opacity = 0.1 * pick(6);
      break;
    case 1:
      function.points[0].value = 0.05 * pick(8);
      break;
    case 2: {
      const std::vector<std::string> styles = drawnStyles();
      const int chosen = pick(static_cast<int>(styles.size()));
      scene.layers[0].styles =
          sceneWithStyle(styles[static_cast<std::size_t>(chosen)]).layers[0].styles;
      break;
    }
    case 3:
      scene.quality.stepVoxels = 0.5 + 0.75 * pick(4);
      break;
    case 4:
      scene.quality.preintegrated = pick(2) == 0;
      break;
    case 5:
      scene.clip.clear();
      if (pick(2) == 0) scene.clip.push_back({{1, 0.3, 0.2}, -5.0 * pick(4)});
      break;
    default:
      if (scene.layers.size() > 1)
        scene.layers.pop_back();
      else
        scene.layers.push_back(sceneWithStyle("tone").layers[0]);
  }
}

// One whole brick, so that a new worker has the same bricks: they go by the scene otherwise.
TEST(SceneUpdate, AfterAnyEditsThePictureIsThatOfANewWorker) {
  std::mt19937 random{5};
  ArraySource source = smoothVolume(gridOf({30, 37, 26}, {1, 1.2, 0.9}));
  Scene scene = resolved(sceneWithStyle("light"), source);
  const Communicator self{MPI_COMM_SELF};
  struct Run {
    node::WorkerOptions options;
    int edits;
  };
  // Ghost layers that a scene before needed stay, and textures of another size round otherwise by
  // 3e-6: with slices both workers load as many from the start.
  const node::WorkerOptions slices{
      .skip = false, .wholeBricks = true, .technique = node::Technique::kSlices, .ghostLayers = 2};
  for (const auto& [options, edits] :
       {Run{{.wholeBricks = true}, 25}, Run{{.skip = false, .wholeBricks = true}, 25},
        Run{slices, 8}}) {
    node::WorkerOptions skipping = options;
    skipping.skip = true;
    node::Worker worker{self, scene, source, options};
    for (int i = 0; i < edits; ++i) {
      edit(scene, random);
      scene = resolved(scene, source);
      worker.update(scene);
      const Camera camera = resolveCamera(scene, {source.info().grid, false});
      RankStatistics statistics;
      const Image<Rgba> updated = wholeFrame(worker.draw(camera, statistics));
      EXPECT_TRUE(
          std::ranges::equal(updated.pixels(), drawAlone(scene, source, camera, skipping).pixels()))
          << "edit " << i << (options.skip ? ", skipping, " : ", not skipping, ")
          << name(options.technique);
    }
  }
}

// Bricks that were split and loaded for other scenes: on and off have the same; a new worker has
// others, so it agrees within the bounds of brick_invariance_test.cpp.
TEST(SceneUpdate, AfterAnyEditsSkippingChangesNothing) {
  std::mt19937 random{6};
  ArraySource source = smoothVolume(gridOf({30, 37, 26}, {1, 1.2, 0.9}));
  Scene scene = resolved(sceneWithStyle("light"), source);
  const Communicator self{MPI_COMM_SELF};
  node::Worker on{self, scene, source, {.bricks = 3, .skip = true}};
  node::Worker off{self, scene, source, {.bricks = 3, .skip = false}};
  for (int i = 0; i < 25; ++i) {
    edit(scene, random);
    scene = resolved(scene, source);
    on.update(scene);
    off.update(scene);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    RankStatistics statistics;
    const Image<Rgba> skipped = wholeFrame(on.draw(camera, statistics));
    const Image<Rgba> visited = wholeFrame(off.draw(camera, statistics));
    EXPECT_TRUE(std::ranges::equal(skipped.pixels(), visited.pixels())) << "edit " << i;
    const Difference d =
        difference(skipped, drawAlone(scene, source, camera, {.bricks = 3, .skip = true}));
    EXPECT_LE(d.largest, 5e-5) << "edit " << i;
    EXPECT_LE(d.rms, 2e-6) << "edit " << i;
  }
}

/// Counts how often it is asked for voxels.
class CountingSource : public ArraySource {
 public:
  using ArraySource::ArraySource;
  void load(const IndexBox& region, std::span<std::byte> out) override {
    ++loads;
    ArraySource::load(region, out);
  }
  int loads = 0;
};

// What styles need of the volume, each more than the one before: an operator's gradients, the
// Laplacian, ghost layers.
TEST(SceneUpdate, WhatIsForeseenIsLoadedOnce) {
  CountingSource source{gridOf({30, 37, 26}, {1, 1.2, 0.9}), [](glm::ivec3 i) {
                          return static_cast<float>(smoothField(glm::dvec3{i}));
                        }};
  std::vector<Scene> scenes;
  for (const char* style : {"plain", "sobel", "laplacian", "halo"})
    scenes.push_back(resolved(sceneWithStyle(style), source));
  scenes.back().layers[0].styles[0].values[0] = 4.0;  // the halo's radius
  const Camera camera = resolveCamera(scenes[0], {source.info().grid, false});
  const Communicator self{MPI_COMM_SELF};
  for (const bool isForeseen : {false, true}) {
    node::WorkerOptions options{.bricks = 2};
    if (isForeseen) options.foreseen = scenes;
    node::Worker worker{self, scenes[0], source, options};
    for (std::size_t i = 1; i < scenes.size(); ++i) {
      const int before = source.loads;
      worker.update(scenes[i]);
      EXPECT_EQ(source.loads == before, isForeseen) << i;
      if (!isForeseen) continue;
      RankStatistics statistics;
      const Image<Rgba> updated = wholeFrame(worker.draw(camera, statistics));
      const Difference d = difference(updated, drawAlone(scenes[i], source, camera, {.bricks = 2}));
      EXPECT_LE(d.largest, 5e-5) << i;
      EXPECT_LE(d.rms, 2e-6) << i;
    }
  }
}

// Loading bricks again drops the ones before, which takes their context, and another worker had
// one since.
TEST(SceneUpdate, BricksAreLoadedAgainAfterAnotherWorkerIsGone) {
  ArraySource source = smoothVolume(gridOf({30, 37, 26}));
  Scene scene = sceneWithStyle("plain");
  scene.quality.preintegrated = false;
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const Communicator self{MPI_COMM_SELF};
  node::Worker worker{self, scene, source, {.bricks = 3}};
  scene.quality.preintegrated = true;
  const Image<Rgba> expected = drawAlone(scene, source, camera, {.bricks = 3});
  worker.update(scene);  // needs ghost layers
  RankStatistics statistics;
  EXPECT_TRUE(
      std::ranges::equal(wholeFrame(worker.draw(camera, statistics)).pixels(), expected.pixels()));
}

class SceneUpdateBy : public testing::TestWithParam<node::Technique> {};

TEST_P(SceneUpdateBy, TilesWithStepsOfTheirOwnAreTheTilesOfWholeFrames) {
  ArraySource source = smoothVolume(gridOf({30, 37, 26}));
  Scene scene = sceneWithStyle("all");
  scene.quality.stepVoxels = 2;
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const Communicator self{MPI_COMM_SELF};
  node::Worker worker{self, scene, source, {.bricks = 2, .technique = GetParam()}};
  const auto draw = [&](const node::StepMap& steps) {
    std::vector<Rgba> pixels;
    RankStatistics statistics;
    const auto view = worker.draw(
        camera, statistics,
        [&](std::size_t count) {
          pixels.resize(count);
          return std::span{pixels};
        },
        &steps);
    return wholeFrame(compositor::Subimage<Rgba>{view.frame, view.active, pixels});
  };
  constexpr int kSide = 16;
  const Image<Rgba> coarse = draw({camera.image, kSide, 2});
  const Image<Rgba> fine = draw({camera.image, kSide, 0.5});
  node::StepMap mixed{camera.image, kSide, 2};
  for (int row = 0; row < mixed.rows(); ++row)
    for (int column = 0; column < mixed.columns; ++column)
      if ((row + column) % 3 == 0) mixed.at(column, row) = 0.5;
  mixed.at(2, 1) = 0;
  const Image<Rgba> both = draw(mixed);
  for (int y = 0; y < camera.image.height; ++y)
    for (int x = 0; x < camera.image.width; ++x) {
      const double step = mixed.at(x / kSide, y / kSide);
      const Rgba expected = step == 0 ? Rgba{} : (step == 2 ? coarse : fine).at(x, y);
      EXPECT_EQ(both.at(x, y), expected) << x << " " << y;
    }
}

INSTANTIATE_TEST_SUITE_P(Techniques, SceneUpdateBy,
                         testing::Values(node::Technique::kRaycast, node::Technique::kSlices),
                         [](const auto& technique) { return std::string{name(technique.param)}; });

}  // namespace
}  // namespace burin::test
