// How bricks are balanced for the views that are known when they are cut.
#include "balanced_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "hiding.hpp"
#include "support/drawing.hpp"
#include "support/mpi_test.hpp"
#include "support/scenes.hpp"
#include "view_rays.hpp"

namespace burin::test {
namespace {

using node::CostEstimate;
using node::CubeGrid;
using node::DrawingCost;
using node::DrawnBlocks;
using node::raysPerCell;
using node::shareNotHidden;

/// Of 32³ cells, 8³ blocks, spacing 1.
const VolumeGrid kGrid = gridOf({33, 33, 33});
const CubeGrid kBlocks{glm::ivec3{0}, glm::ivec3{8}, 4};

/// Looks along z at the volume's centre from `distance` before it.
Camera alongZ(Projection projection, double distance, double pixelSize) {
  Camera camera;
  camera.projection = projection;
  camera.eyeWorld = glm::dvec3{16, 16, 16 - distance};
  camera.forward = {0, 0, 1};
  camera.right = {-1, 0, 0};
  camera.pixelSize = pixelSize;
  camera.image = {64, 64};
  return camera;
}

TEST(RaysPerCell, FallWithTheSquareOfTheDepth) {
  const auto rays = raysPerCell(alongZ(Projection::kPerspective, 40, 2.0 / 64), kBlocks, kGrid);
  for (int z = 0; z < 8; ++z) {
    const double depth = 24 + 4 * z + 2;  // of the blocks' centres
    EXPECT_NEAR(rays[kBlocks.index({3, 4, z})], 40 * 40 / (depth * depth), 1e-6);
  }
}

TEST(RaysPerCell, AreNoneBesideTheImageAndBehindTheEye) {
  // An image of 8 by 8 world units in the middle: half a block beyond the four blocks around it.
  const auto parallel =
      raysPerCell(alongZ(Projection::kOrthographic, 40, 8.0 / 64), kBlocks, kGrid);
  const auto inside = raysPerCell(alongZ(Projection::kPerspective, 0, 2.0 / 64), kBlocks, kGrid);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(parallel[kBlocks.index({i, 3, 5})], i == 3 || i == 4 ? 1 : 0);
    EXPECT_EQ(inside[kBlocks.index({4, 4, i})] > 0, i >= 3);  // [12, 16) touches the eye's plane
  }
}

TEST(Hiding, EndsWhereABrickIsOpaqueAndBeginsAnewInTheNext) {
  // Optical depth 2 in each block: after three of them 6 < -ln 0.002 = 6.2, after four it is 8.
  const std::vector<float> extinction(512, 0.5f);
  std::vector<std::uint32_t> brick(512);
  for (int z = 5; z < 8; ++z)
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) brick[kBlocks.index({x, y, z})] = 1;
  const auto shares = shareNotHidden(alongZ(Projection::kOrthographic, 40, 0.5), kGrid,
                                     {kBlocks, extinction, brick}, 0.002, 16);
  for (int z = 0; z < 8; ++z) EXPECT_EQ(shares[kBlocks.index({2, 5, z})], z == 4 ? 0 : 1) << z;
}

TEST(BalancedTree, HoldsVoxelsThatNoViewSees) {
  // The picture shows one corner. A rank must not have to hold nearly all the rest.
  const std::vector<std::uint8_t> marks(512, 1);
  Camera camera = alongZ(Projection::kOrthographic, 40, 8.0 / 64);
  camera.eyeWorld += glm::dvec3{-12, -12, 0};
  DrawnBlocks drawn;
  drawn.grid = kGrid;
  drawn.cubes = kBlocks;
  drawn.marks = marks;
  drawn.views = std::span{&camera, 1};
  BrickTree::Request request;
  request.grid = kGrid;
  request.owners = 8;
  const BrickTree tree = node::balancedTree(request, DrawingCost{drawn});
  std::size_t most = 0;
  for (std::uint32_t i = 0; i < 8; ++i) most = std::max(most, tree.brickCells(BrickId{i}).count());
  // A cell counts at least a quarter of the mean, so four times an eighth of them; the planes lie
  // on whole cells, half a one off in the eight that the thinnest side of a brick here has.
  EXPECT_LE(static_cast<double>(most), 4.0 / 8 * 32 * 32 * 32 * (1 + 0.5 / 8));
}

/// Rounds of the rays' loops (samples and leaps), most of a brick over the mean, of eight that are
/// drawn each by itself as ranks would.
double measuredUnevenness(const Scene& scene, ArraySource& source, const Camera& camera,
                          const std::vector<Camera>& views) {
  const Communicator self{MPI_COMM_SELF};
  node::WorkerOptions options;
  options.bricks = 8;
  options.countSamples = true;
  options.views = views;
  node::Worker worker{self, scene, source, options};
  std::vector<Rgba> room(camera.image.pixels());
  double most = 0;
  double sum = 0;
  for (std::uint32_t i = 0; i < 8; ++i) {
    RankStatistics statistics;
    worker.drawBrick(BrickId{i}, camera, statistics,
                     [&](std::size_t pixels) { return std::span{room}.first(pixels); });
    const auto rounds = static_cast<double>(statistics.samplesVisited + statistics.leaps);
    most = std::max(most, rounds);
    sum += rounds;
  }
  return most * 8 / sum;
}

TEST(BalancedTree, BricksTakeAsManyRoundsEach) {
  ArraySource source{gridOf({49, 49, 49}), [](glm::ivec3 i) { return i.x % 2 == 0 ? 1.f : 0.9f; }};
  Scene scene = sceneWithStyle("plain");
  scene.imageSize = {96, 96};
  scene.camera.verticalFovDeg = 60;
  scene.quality = {.stepVoxels = 0.5, .termination = 0.002};
  // Planes on whole cells, half a one off in the 16 or more that a brick is wide, three times:
  // 1.1. Opaque material ends a ray after 6.2 / 0.51 = 12 cells, found in blocks of 4: two cells
  // more or fewer, a sixth.
  const std::pair<double, double> cases[] = {{0.01, 1.1}, {0.4, 1.1 * 7 / 6}};
  for (const auto& [opacity, most] : cases) {
    scene.layers[0].transferFunction = {{{0.8, {255, 0, 0}, opacity}, {1.0, {255, 0, 0}, opacity}},
                                        {}};
    scene = resolved(scene, source);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    EXPECT_GT(measuredUnevenness(scene, source, camera, {}), 1.5) << "octants: no test";
    EXPECT_LE(measuredUnevenness(scene, source, camera, {camera}), most) << opacity;
  }
}

}  // namespace
}  // namespace burin::test
