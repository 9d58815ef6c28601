// The picture does not depend on the number of ranks: the whole way from the volume to rank 0's
// frame on all ranks, against the same scene drawn by rank 0 alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "burin/compositor/compositor.hpp"
#include "node/layer_modes.hpp"
#include "support/drawing.hpp"
#include "support/mpi_test.hpp"

namespace burin::test {
namespace {

/// Collective. The frame in rank 0's memory; a value on rank 0 alone.
std::optional<Image<Rgba>> drawTogether(node::Worker& worker, const Camera& camera) {
  RankStatistics statistics;
  const compositor::Subimage<Rgba> mine = worker.draw(camera, statistics);
  compositor::Compositor merge{world()};
  const auto view =
      merge.toRoot<compositor::Over>({}, worker.visibilityOrder(camera), mine, {}, statistics);
  if (!view) return std::nullopt;
  Image<Rgba> frame{view->size()};
  std::ranges::copy(view->pixels(), frame.pixels().begin());
  return frame;
}

void expectSameAsAlone(const Scene& scene, node::BrickSource& source,
                       const std::vector<Camera>& cameras, const node::WorkerOptions& options) {
  node::Worker together{world(), scene, source, options};
  std::optional<node::Worker> alone;
  const Communicator self{MPI_COMM_SELF};
  if (world().isRoot())
    alone.emplace(
        self, scene, source,
        node::WorkerOptions{.bricks = 1, .technique = options.technique, .labels = options.labels});
  for (const Camera& camera : cameras) {
    const std::optional<Image<Rgba>> frame = drawTogether(together, camera);
    ASSERT_EQ(frame.has_value(), world().isRoot());
    if (!frame) continue;
    RankStatistics statistics;
    const Image<Rgba> one = wholeFrame(alone->draw(camera, statistics));
    const Difference d = difference(one, *frame);
    EXPECT_GT(largestAlpha(one), 0.3);
    EXPECT_LE(d.largest, kLargest) << scene.layers[0].name;
    EXPECT_LE(d.rms, kRms) << scene.layers[0].name;
  }
}

std::vector<Camera> cameras(Scene scene, const VolumeGrid& grid) {
  std::vector<Camera> result;
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    scene.camera = {.azimuthDeg = 35, .elevationDeg = 25, .projection = projection};
    result.push_back(resolveCamera(scene, {grid, false}));
  }
  scene.camera = {.verticalFovDeg = 90};
  scene.camera.eye = grid.centreWorld() + glm::dvec3{1, -2, 0.5};
  scene.camera.target = grid.centreWorld() + glm::dvec3{10, 8, 3};
  result.push_back(resolveCamera(scene, {grid, false}));
  return result;
}

TEST(RankInvariance, EveryStyle) {
  ArraySource source = smoothVolume(gridOf({46, 37, 29}, {1.0, 0.8, 1.9}));
  for (const std::string& style : drawnStyles()) {
    const Scene scene = resolved(sceneWithStyle(style), source);
    expectSameAsAlone(scene, source, cameras(scene, source.info().grid), {});
  }
}

/// Collective. The ranks' subimages as one image in rank 0's memory; empty on the others.
template <compositor::PixelAlgebra A>
Image<typename A::Pixel> together(const compositor::Subimage<typename A::Pixel>& mine,
                                  const std::vector<Rank>& order) {
  RankStatistics statistics;
  compositor::Compositor merge{world()};
  const auto view = merge.toRoot<A>({}, order, mine, {}, statistics);
  if (!view) return {};
  Image<typename A::Pixel> image{view->size()};
  std::ranges::copy(view->pixels(), image.pixels().begin());
  return image;
}

TEST(RankInvariance, SurfacesAndProjections) {
  ArraySource source = smoothVolume(gridOf({36, 37, 29}, {1.0, 0.8, 1.4}));
  Scene scene = sceneOfAllModes();
  scene.layers.pop_back();  // groups: media with a surface, the largest value, the mean
  scene = resolved(scene, source);
  const Camera camera = cameras(scene, source.info().grid).front();
  node::Worker worker{world(), scene, source, {}};
  const std::vector<Rank> order = worker.visibilityOrder(camera);
  RankStatistics statistics;
  std::vector<node::GroupImage> images;
  images.emplace_back(together<compositor::Over>(worker.draw(camera, statistics), order));
  images.emplace_back(
      together<compositor::LargestValue>(worker.drawLargest(camera, statistics, 1), order));
  images.emplace_back(
      together<compositor::WeightedSum>(worker.drawSums(camera, statistics, 2), order));
  if (!world().isRoot()) return;
  const Communicator self{MPI_COMM_SELF};
  node::Worker alone{self, scene, source, {.bricks = 1}};
  const std::vector<node::GroupImage> one = drawGroups(alone, scene, camera, statistics);
  EXPECT_TRUE(std::ranges::equal(std::get<Image<compositor::LargestValuePixel>>(images[1]).pixels(),
                                 std::get<Image<compositor::LargestValuePixel>>(one[1]).pixels()));
  const Image<Rgba> merged = alone.merge(one);
  EXPECT_GT(largestAlpha(merged), 0.3);
  const Image<Rgba> ofAll = worker.merge(images);
  const Difference d =
      differenceBeyond(surfaceSlack(scene, source, camera), std::span<const Rgba>{merged.pixels()},
                       std::span<const Rgba>{ofAll.pixels()});
  EXPECT_LE(d.largest, kLargest);
  EXPECT_LE(d.rms, kRms);
}

TEST(RankInvariance, MoreBricksThanRanks) {
  ArraySource source = smoothVolume(gridOf({40, 40, 30}));
  const Scene scene = resolved(sceneWithStyle("all"), source);
  expectSameAsAlone(scene, source, cameras(scene, source.info().grid), {.bricks = 21});
}

TEST(RankInvariance, Slices) {
  ArraySource source = smoothVolume(gridOf({30, 26, 22}));
  Scene scene = sceneWithStyle("edges");
  scene.quality.stepVoxels = 1;
  scene = resolved(scene, source);
  expectSameAsAlone(scene, source, cameras(scene, source.info().grid),
                    {.bricks = 5, .technique = node::Technique::kSlices});
}

TEST(RankInvariance, Labels) {
  const VolumeGrid grid = gridOf({46, 37, 29}, {1.0, 0.8, 1.9});
  ArraySource source = smoothVolume(grid);
  ArraySource labels = ArraySource::of<std::uint8_t>(grid, node::VoxelType::kU8, [](glm::ivec3 i) {
    return static_cast<std::uint8_t>((i.x / 9 + i.y / 7 + i.z / 5) % 4);
  });
  Scene scene = sceneWithStyle("light");
  scene.layers.push_back(sceneWithStyle("plain").layers[0]);
  scene.layers[0].labels = {1, 3};
  scene.layers[1].labels = {2};
  scene = resolved(scene, source);
  expectSameAsAlone(scene, source, cameras(scene, grid), {.bricks = 7, .labels = &labels});
}

TEST(RankInvariance, DedicatedHost) {
  if (world().size() == 1) GTEST_SKIP() << "a dedicated host needs a second rank";
  ArraySource source = smoothVolume(gridOf({40, 40, 30}));
  const Scene scene = resolved(sceneWithStyle("tone"), source);
  expectSameAsAlone(scene, source, cameras(scene, source.info().grid), {.dedicatedHost = true});
}

TEST(RankInvariance, MoreRanksThanCells) {
  ArraySource source = smoothVolume(gridOf({3, 2, 2}, {10, 10, 10}));  // two cells
  const Scene scene = resolved(sceneWithStyle("plain"), source);
  expectSameAsAlone(scene, source, cameras(scene, source.info().grid), {});
}

TEST(RankInvariance, RanksWithNothingToShow) {
  // One small ball, all in one block, and bricks of some ranks that do not touch it.
  ArraySource source{gridOf({81, 81, 81}), [](glm::ivec3 i) {
                       const double r = glm::distance(glm::dvec3{i}, glm::dvec3{24});
                       return static_cast<float>(std::max(1 - r / 6, 0.0));
                     }};
  Scene scene = sceneWithStyle("light");
  scene.camera.zoom = 3;
  scene.layers[0].transferFunction = {{{0.1, {255, 0, 0}, 0}, {0.4, {255, 0, 0}, 0.5}}, {}};
  scene = resolved(scene, source);
  const std::vector<Camera> views = cameras(scene, source.info().grid);
  node::Worker worker{world(), scene, source, {.bricks = 4 * world().size()}};
  Scene nothing = scene;
  nothing.layers[0].transferFunction.points[1].opacity = 0;
  worker.update(nothing);
  EXPECT_TRUE(worker.visibilityOrder(views[0]).size() <= static_cast<std::size_t>(world().size()));
  if (const auto frame = drawTogether(worker, views[0])) {
    EXPECT_EQ(largestAlpha(*frame), 0);
  }
  // From nothing at all, loaded nowhere, to the ball, and back.
  node::Worker grows{world(), nothing, source, {.bricks = 4 * world().size()}};
  EXPECT_TRUE(grows.visibilityOrder(views[0]).empty());
  if (const auto frame = drawTogether(grows, views[0])) {
    EXPECT_EQ(largestAlpha(*frame), 0);
  }
  grows.update(scene);
  worker.update(scene);
  const auto after = drawTogether(grows, views[0]);
  const auto before = drawTogether(worker, views[0]);
  if (!world().isRoot()) return;
  EXPECT_GT(largestAlpha(*before), 0.3);
  // Another split, as the one for nothing cannot know what will be seen.
  EXPECT_LE(difference(*before, *after).largest, kLargest);
}

// Two bytes a voxel of its own bricks with their ghost layers; 9 bytes per 64 of these voxels for
// macrocells, and as many per 64 of the volume's for the survey's blocks. The rest does not grow.
TEST(RankInvariance, ARankHoldsItsOwnBricksAlone) {
  const VolumeGrid grid = gridOf({97, 85, 77});
  ArraySource source = ArraySource::of<std::uint16_t>(
      grid, node::VoxelType::kU16,
      [](glm::ivec3 i) { return static_cast<std::uint16_t>((7 * i.x + 5 * i.y + 3 * i.z) % 200); });
  Scene scene = sceneWithStyle("light");
  scene.layers[0].transferFunction = {{{0, {255, 0, 0}, 0.1}, {255, {255, 0, 0}, 0.2}}, {}};
  scene = resolved(scene, source);
  node::Worker worker{world(), scene, source, {}};
  RankStatistics statistics;
  worker.draw(cameras(scene, grid).front(), statistics);
  std::size_t own = 0, stored = 0;
  const IndexBox volume{glm::ivec3{0}, grid.dims};
  const int ghosts = ghostLayersNeeded(scene);
  for (const BrickId brick : worker.tree().bricksOf(static_cast<int>(world().rank()))) {
    const IndexBox& cells = worker.tree().brickCells(brick);
    own += cells.count();
    stored += intersection({cells.lo - ghosts, cells.hi + 1 + ghosts}, volume).count();
  }
  const auto held = static_cast<double>(statistics.residentVoxelBytes);
  constexpr double kRest = 100e3;
  EXPECT_GE(held, 2 * static_cast<double>(own));
  EXPECT_LE(held, (2 + 9.0 / 64) * static_cast<double>(stored) +
                      9.0 / 64 * static_cast<double>(volume.count()) + kRest);
}

TEST(RankInvariance, SameLayoutTwiceIsBitIdentical) {
  ArraySource source = smoothVolume(gridOf({40, 40, 30}));
  const Scene scene = resolved(sceneWithStyle("all"), source);
  const Camera camera = cameras(scene, source.info().grid).front();
  node::Worker first{world(), scene, source, {}};
  node::Worker second{world(), scene, source, {}};
  const auto a = drawTogether(first, camera);
  const auto b = drawTogether(second, camera);
  ASSERT_EQ(a.has_value(), world().isRoot());
  if (!a) return;
  EXPECT_TRUE(std::ranges::equal(a->pixels(), b->pixels()));
}

}  // namespace
}  // namespace burin::test
