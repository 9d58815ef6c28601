// The picture does not depend on how the volume is cut into bricks (design: rank invariance is a
// tested number).

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

// Positions are the same bit for bit; what differs is the texture unit's own float coordinates, by
// about 2^-24 of a texture's extent times its size in voxels, and the grouping of over. For
// transfer functions no steeper than full opacity over 1/16 of the range this was measured to
// reach 1.3e-5.
constexpr double kLargest = 5e-5;
constexpr double kRms = 2e-6;

struct View {
  const char* name;
  CameraChoice camera;
};

/// Eyes around, inside and in a split plane of a volume with that box centre.
std::vector<View> views(const VolumeGrid& grid) {
  const glm::dvec3 centre = grid.centreWorld();
  const double radius = grid.boundingRadius();
  CameraChoice around{.azimuthDeg = 35, .elevationDeg = 25};
  CameraChoice parallel = around;
  parallel.projection = Projection::kOrthographic;
  CameraChoice inside{.verticalFovDeg = 90};
  inside.eye = centre + glm::dvec3{0.11, -0.07, 0.05} * radius;
  inside.target = centre + glm::dvec3{0.5, 0.8, 0.3} * radius;
  // In the plane through the middle voxel of the x axis, where the tree splits first.
  CameraChoice inPlane{.verticalFovDeg = 40};
  const glm::dvec3 middle = grid.worldFromIndex(glm::dvec3{grid.dims / 2});
  inPlane.eye = glm::dvec3{middle.x, centre.y + 0.4 * radius, centre.z + 2.5 * radius};
  inPlane.target = glm::dvec3{middle.x, centre.y, centre.z};
  CameraChoice parallelInPlane{.azimuthDeg = 0, .elevationDeg = 0};
  parallelInPlane.projection = Projection::kOrthographic;
  return {{"around", around},
          {"parallel", parallel},
          {"inside", inside},
          {"in a split plane", inPlane},
          {"parallel to split planes", parallelInPlane}};
}

/// Of the views two for the nth number of bricks: a style meets every number and every view, and
/// over the styles every number meets every view.
std::array<std::size_t, 2> viewsOf(std::size_t n, const std::string& style) {
  constexpr std::size_t kViews = 5;
  const std::vector<std::string> styles = drawnStyles();
  const auto number = static_cast<std::size_t>(std::ranges::find(styles, style) - styles.begin());
  return {(n + number) % kViews, (n + number + 2) % kViews};
}

class BrickInvariance : public testing::TestWithParam<std::string> {};

TEST_P(BrickInvariance, AnyNumberOfBricksDrawsTheSamePicture) {
  const VolumeGrid grid = gridOf({46, 37, 29}, {1.0, 0.8, 1.9});
  ArraySource source = smoothVolume(grid);
  Scene scene = resolved(sceneWithStyle(GetParam()), source);
  scene.lights = {{.direction = {0.2, 0.5, 0.8}}};
  const Communicator self{MPI_COMM_SELF};

  std::vector<Camera> cameras;
  for (const View& view : views(grid)) {
    scene.camera = view.camera;
    cameras.push_back(resolveCamera(scene, {grid, false}));
  }
  RankStatistics statistics;
  std::vector<Image<Rgba>> one;
  {
    node::Worker worker{self, scene, source, {.bricks = 1}};
    ASSERT_EQ(worker.tree().brickCount(), 1u);
    for (const Camera& camera : cameras) {
      one.push_back(wholeFrame(worker.draw(camera, statistics)));
      EXPECT_GT(largestAlpha(one.back()), 0.3);
    }
  }
  std::size_t n = 0;
  for (const int bricks : {2, 3, 4, 5, 6, 7, 8, 13, 64}) {
    node::Worker worker{self, scene, source, {.bricks = bricks}};
    ASSERT_EQ(worker.tree().brickCount(), static_cast<std::size_t>(bricks));
    for (const std::size_t i : viewsOf(n++, GetParam())) {
      const Image<Rgba> many = wholeFrame(worker.draw(cameras[i], statistics));
      const Difference d = difference(one[i], many);
      EXPECT_TRUE(d.finite);
      EXPECT_LE(d.largest, kLargest) << bricks << " bricks, " << views(grid)[i].name;
      EXPECT_LE(d.rms, kRms) << bricks << " bricks, " << views(grid)[i].name;
    }
  }
}

// over of n subimages in two groupings: 3(n - 1) roundings of 2^-24 each, twice; n = 5.
TEST(BrickInvariance, BricksDrawnAloneMakeTheFrame) {
  ArraySource source = smoothVolume(gridOf({40, 40, 40}));
  const Scene scene = resolved(sceneWithStyle("light"), source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const Communicator self{MPI_COMM_SELF};
  node::Worker worker{self, scene, source, {.bricks = 5}};
  RankStatistics statistics;
  const Image<Rgba> all = wholeFrame(worker.draw(camera, statistics));
  Image<Rgba> merged{camera.image};
  for (const BrickId brick : worker.tree().visibilityOrder(camera)) {
    compositor::Subimage<Rgba> alone{camera.image, {}, {}};
    alone.active = worker
                       .drawBrick(brick, camera, statistics,
                                  [&](std::size_t pixels) {
                                    alone.pixels.resize(pixels);
                                    return std::span{alone.pixels};
                                  })
                       .active;
    const Image<Rgba> behind = wholeFrame(alone);
    for (std::size_t i = 0; i < behind.pixels().size(); ++i)
      merged.pixels()[i] = over(merged.pixels()[i], behind.pixels()[i]);
  }
  EXPECT_GT(largestAlpha(all), 0.3);
  EXPECT_LE(difference(all, merged).largest, 24 * 0x1p-24);
}

INSTANTIATE_TEST_SUITE_P(Styles, BrickInvariance, testing::ValuesIn(drawnStyles()),
                         [](const auto& style) { return style.param; });

TEST(BrickInvariance, CutSurfaces) {
  const VolumeGrid grid = gridOf({46, 37, 29}, {1.0, 0.8, 1.9});
  ArraySource source = smoothVolume(grid);
  Scene scene = sceneWithStyle("all");
  const glm::dvec3 centre = grid.centreWorld();
  scene.clip = {{{1, 0.2, -0.3}, -glm::dot({1, 0.2, -0.3}, centre)}};
  scene.clipBox = ClipBox{centre - 11.0, centre + glm::dvec3{15, 9, 13}};
  scene.camera.azimuthDeg = -60;
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {grid, false});
  const Image<Rgba> one = drawAlone(scene, source, camera, {.bricks = 1});
  EXPECT_GT(largestAlpha(one), 0.3);
  for (const int bricks : {2, 5, 13}) {
    const Difference d = difference(one, drawAlone(scene, source, camera, {.bricks = bricks}));
    EXPECT_LE(d.largest, kLargest) << bricks;
    EXPECT_LE(d.rms, kRms) << bricks;
  }
}

TEST(BrickInvariance, TerminationAddsAtMostItsThreshold) {
  ArraySource source = smoothVolume(gridOf({40, 40, 40}));
  Scene scene = sceneWithStyle("all");
  scene.layers[0].transferFunction = gentleTransferFunction(1.9);
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const Image<Rgba> whole = drawAlone(scene, source, camera);
  for (const double threshold : {0.002, 0.05}) {
    scene.quality.termination = threshold;
    for (const int bricks : {1, 5, 13}) {
      const Difference d = difference(whole, drawAlone(scene, source, camera, {.bricks = bricks}));
      EXPECT_LE(d.largest, threshold + kLargest) << bricks;
      EXPECT_GT(d.largest, 0.01 * threshold) << "nothing was terminated: the test shows nothing";
    }
  }
}

TEST(BrickInvariance, SameLayoutTwiceIsBitIdentical) {
  ArraySource source = smoothVolume(gridOf({33, 30, 28}));
  Scene scene = sceneWithStyle("all");
  scene.quality.termination = 0.002;
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const Image<Rgba> first = drawAlone(scene, source, camera, {.bricks = 5});
  const Image<Rgba> second = drawAlone(scene, source, camera, {.bricks = 5});
  EXPECT_TRUE(std::ranges::equal(first.pixels(), second.pixels()));
}

TEST(BrickInvariance, OneGhostLayerLessThanDeclaredShows) {
  ArraySource source = smoothVolume(gridOf({40, 40, 40}));
  for (const char* style : {"light", "sobel", "regression", "laplacian", "halo", "widgets"}) {
    const Scene scene = resolved(sceneWithStyle(style), source);
    const int less = ghostLayersNeeded(scene) - 1;
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    const Image<Rgba> one = drawAlone(scene, source, camera, {.bricks = 1, .ghostLayers = less});
    const Image<Rgba> many = drawAlone(scene, source, camera, {.bricks = 8, .ghostLayers = less});
    EXPECT_GT(difference(one, many).largest, kLargest) << style;
  }
}

}  // namespace
}  // namespace burin::test
