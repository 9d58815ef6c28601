// Layers that are projections, largest and mean values: in closed form, against the reference, and
// between other layers.

#include <gtest/gtest.h>

#include "node/layer_modes.hpp"
#include "support/against_reference.hpp"

namespace burin::test {
namespace {

/// A layer that shows a value of [0, 1] as its opacity.
Layer valueAsOpacity(LayerMode mode) {
  Layer layer = projectionLayer(mode);
  layer.transferFunction.points = {{0, {255, 255, 255}, 0}, {1, {255, 255, 255}, 1}};
  return layer;
}

/// Where the ray of a pixel enters and leaves the box [0, size]; equal if it misses it.
std::pair<glm::dvec3, glm::dvec3> chord(const Camera& camera, int column, int row,
                                        const glm::dvec3& size) {
  const glm::dvec3 origin =
      camera.eyeWorld +
      camera.pixelSize * ((column + 0.5 - 0.5 * camera.image.width) * camera.right +
                          (0.5 * camera.image.height - row - 0.5) * camera.up);
  const glm::dvec3 a = (0.0 - origin) / camera.forward;
  const glm::dvec3 b = (size - origin) / camera.forward;
  const glm::dvec3 near = glm::min(a, b);
  const glm::dvec3 far = glm::max(a, b);
  const double begin = std::max({near.x, near.y, near.z});
  const double end = std::max(begin, std::min({far.x, far.y, far.z}));
  return {origin + begin * camera.forward, origin + end * camera.forward};
}

// A field that rises linearly: its mean is that of the ends, its largest value lies at one of them,
// less half a segment at most, as the last sample is its segment's middle.
TEST(Projection, OfALinearFieldInClosedForm) {
  const VolumeGrid grid = gridOf({21, 17, 25});
  const glm::dvec3 slope{0.01, 0.02, 0.015};
  ArraySource source{
      grid, [&](glm::ivec3 i) { return static_cast<float>(glm::dot(slope, glm::dvec3{i})); }};
  for (const LayerMode mode : {LayerMode::kMip, LayerMode::kAverage})
    for (const int bricks : {1, 5}) {
      Scene scene = sceneWithStyle("plain");
      scene.imageSize = {40, 32};
      scene.layers = {valueAsOpacity(mode)};
      scene.camera = {
          .azimuthDeg = 33, .elevationDeg = -21, .projection = Projection::kOrthographic};
      scene = resolved(scene, source);
      const Camera camera = resolveCamera(scene, {grid, false});
      const Image<Rgba> image = drawAlone(scene, source, camera, {.bricks = bricks});
      int met = 0;
      for (int row = 0; row < camera.image.height; ++row)
        for (int column = 0; column < camera.image.width; ++column) {
          const auto [first, last] = chord(camera, column, row, glm::dvec3{grid.dims - 1});
          if (glm::distance(first, last) < 1e-3) continue;  // rounding decides
          ++met;
          const double a = glm::dot(slope, first);
          const double b = glm::dot(slope, last);
          const double seen = image.at(column, row).a;
          if (mode == LayerMode::kAverage) {
            // Products, their sum (compensated) and the merge of 5 bricks: some ten roundings of 1.
            EXPECT_NEAR(seen, (a + b) / 2, 1e-6) << column << " " << row;
          } else {
            const double half =
                0.5 * scene.quality.stepVoxels * std::abs(glm::dot(slope, camera.forward));
            EXPECT_LE(seen, std::max(a, b) + 1e-6);
            EXPECT_GE(seen, std::max(a, b) - half - 1e-6);
          }
        }
      EXPECT_GT(met, 300);
    }
}

TEST(Projection, AmongAllModesIsTheReferences) {
  ArraySource source = smoothVolume(gridOf({32, 33, 30}, {1, 1.2, 0.8}));
  Scene scene = sceneOfAllModes();
  scene.clip = {{{1, 0.2, -0.3}, -8}};
  scene.camera = {.azimuthDeg = 40, .elevationDeg = 25};
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const DrawnAndTrue both = drawWithReference(scene, source, camera, {.bricks = 7});
  EXPECT_GT(largestAlpha(both.drawn), 0.5);
  EXPECT_LE(differenceBeyond(surfaceSlack(scene, source, camera),
                             std::span<const Rgba>{both.drawn.pixels()},
                             std::span<const ReferencePixel>{both.truth})
                .largest,
            kReferenceBound);
}

TEST(Projection, VoxelsThatAreNotValidDoNotCount) {
  ArraySource source{gridOf({24, 24, 24}), [](glm::ivec3 i) {
                       const float value = static_cast<float>(smoothField(glm::dvec3{i}));
                       return i.x > 8 && i.y < 12 ? std::nanf("") : value;
                     }};
  for (const LayerMode mode : {LayerMode::kMip, LayerMode::kAverage}) {
    Scene scene = sceneWithStyle("plain");
    scene.imageSize = {40, 32};
    scene.layers = {projectionLayer(mode)};
    scene = resolved(scene, source);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    // A sample whose weight of valid voxels rounds across 1/2 moves a mean by its share of it.
    const Difference d = againstReference(scene, source, camera, {.bricks = 3});
    EXPECT_TRUE(d.finite);
    EXPECT_LE(d.rms, 1e-4);
  }
}

TEST(Projection, LargestValuesAreTheSameInAnyBricksBitForBit) {
  const VolumeGrid grid = gridOf({46, 37, 29}, {1.0, 0.8, 1.9});
  ArraySource source = smoothVolume(grid);
  Scene scene = resolved(sceneOfAllModes(), source);
  scene.camera = {.azimuthDeg = 35, .elevationDeg = 25};
  const Camera camera = resolveCamera(scene, {grid, false});
  const Communicator self{MPI_COMM_SELF};
  constexpr std::size_t kMip = 1;  // of the groups
  const std::vector<double> slack = surfaceSlack(scene, source, camera);
  std::optional<Image<compositor::LargestValuePixel>> largest;
  std::optional<Image<Rgba>> one;
  for (const int bricks : {1, 2, 3, 5, 8, 64}) {
    node::Worker worker{self, scene, source, {.bricks = bricks}};
    RankStatistics statistics;
    const std::vector<node::GroupImage> images = drawGroups(worker, scene, camera, statistics);
    ASSERT_EQ(images.size(), 4u);
    const auto& mine = std::get<Image<compositor::LargestValuePixel>>(images[kMip]);
    const Image<Rgba> merged = worker.merge(images);
    if (!largest) {
      largest = mine;
      one = merged;
      EXPECT_GT(largestAlpha(merged), 0.5);
      continue;
    }
    EXPECT_TRUE(std::ranges::equal(mine.pixels(), largest->pixels())) << bricks;
    const Difference d = differenceBeyond(slack, std::span<const Rgba>{one->pixels()},
                                          std::span<const Rgba>{merged.pixels()});
    EXPECT_LE(d.largest, kLargest) << bricks;
    EXPECT_LE(d.rms, kRms) << bricks;
  }
}

TEST(Projection, SkippingChangesNoBitAndSavesSamples) {
  ArraySource source{gridOf({40, 36, 33}), [](glm::ivec3 i) {
                       const double r = glm::distance(glm::dvec3{i}, {14, 17, 20});
                       return static_cast<float>(std::clamp(1 - r / 11, 0.0, 1.0));
                     }};
  const Communicator self{MPI_COMM_SELF};
  Scene scene = sceneOfAllModes();
  std::erase_if(scene.layers, [](const Layer& l) { return l.mode == LayerMode::kAverage; });
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  node::Worker skipping{self, scene, source, {.bricks = 4, .skip = true, .countSamples = true}};
  node::Worker visiting{self, scene, source, {.bricks = 4, .skip = false, .countSamples = true}};
  RankStatistics on, off;
  const Image<Rgba> skipped = drawFrame(skipping, scene, camera, on);
  EXPECT_GT(largestAlpha(skipped), 0.5);
  EXPECT_TRUE(
      std::ranges::equal(skipped.pixels(), drawFrame(visiting, scene, camera, off).pixels()));
  EXPECT_LT(on.samplesVisited, off.samplesVisited);
}

// Later layers lie over earlier ones, whichever comes first on the ray.
TEST(Projection, LiesWhereTheListSays) {
  ArraySource source{gridOf({12, 12, 12}), [](glm::ivec3) { return 0.5f; }};
  Scene scene = sceneWithStyle("plain");
  scene.imageSize = {9, 9};
  scene.camera.projection = Projection::kOrthographic;
  Layer medium = scene.layers[0];
  medium.transferFunction.points = {{0, {0, 0, 255}, 0.9}, {1, {0, 0, 255}, 0.9}};
  Layer projection = projectionLayer(LayerMode::kMip);
  projection.transferFunction.points = {{0, {255, 0, 0}, 0.25}, {1, {255, 0, 0}, 0.25}};
  for (const LayerMode mode : {LayerMode::kMip, LayerMode::kAverage})
    for (const bool isOnTop : {true, false}) {
      projection.mode = mode;
      scene.layers = {medium, projection};
      if (!isOnTop) std::ranges::reverse(scene.layers);
      const Scene made = resolved(scene, source);
      const Rgba pixel =
          drawAlone(made, source, resolveCamera(made, {source.info().grid, false})).at(4, 4);
      // The medium takes 11 lengths of 90 %: all but 1e-11 of the light.
      EXPECT_NEAR(pixel.r, isOnTop ? 0.25 : 0.0, 1e-6);
      EXPECT_NEAR(pixel.b, isOnTop ? 0.75 : 1.0, 1e-6);
      EXPECT_NEAR(pixel.a, 1.0, 1e-6);
    }
}

// An edit from one kind of layers to another and back draws what was drawn.
TEST(Projection, ComesAndGoesAsAnEdit) {
  ArraySource source = smoothVolume(gridOf({20, 18, 22}));
  const Communicator self{MPI_COMM_SELF};
  const Scene modes = resolved(sceneOfAllModes(), source);
  const Scene plain = resolved(sceneWithStyle("light"), source);
  node::Worker worker{self, modes, source, {.bricks = 2, .wholeBricks = true}};
  const Camera camera = resolveCamera(modes, {source.info().grid, false});
  RankStatistics statistics;
  const Image<Rgba> first = drawFrame(worker, modes, camera, statistics);
  worker.update(plain);
  const Image<Rgba> between = drawFrame(worker, plain, camera, statistics);
  // Its bricks keep the ghost layers of the surfaces: other textures, whose last bits differ.
  EXPECT_LE(difference(between, drawAlone(plain, source, camera, {.bricks = 2})).largest, kLargest);
  worker.update(modes);
  EXPECT_TRUE(
      std::ranges::equal(first.pixels(), drawFrame(worker, modes, camera, statistics).pixels()));
}

}  // namespace
}  // namespace burin::test
