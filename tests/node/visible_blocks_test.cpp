// What is not loaded shows nothing, by the transfer functions themselves.

#include "visible_blocks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "support/mpi_test.hpp"
#include "support/scenes.hpp"

namespace burin::node {
namespace {

/// A ball of values up to 1 in a field of faint noise.
float ballInNoise(const glm::ivec3& i, const glm::dvec3& centre, double radius, unsigned seed) {
  std::minstd_rand random{seed + 1000003u * static_cast<unsigned>(i.x + 997 * (i.y + 991 * i.z))};
  const double r = glm::distance(glm::dvec3{i}, centre) / radius;
  return static_cast<float>(std::max(1 - r, 0.0) + 1e-10 * static_cast<double>(random() % 1000000));
}

class VisibleBlocksTest : public testing::Test {
 protected:
  void prepare(BrickSource& source, const TransferFunction& function,
               const std::vector<ClipPlane>& clip = {}) {
    grid = source.info().grid;
    scene = test::sceneWithStyle("plain");
    scene.layers[0].transferFunction = function;
    scene.clip = clip;
    resolveScene(scene, {grid, false});
    const VolumeSurvey survey = surveyVolume(test::world(), source, {});
    const ValueScale scale = valueScaleOf(source.info().type, survey);
    const VisibleBlocks blocks{survey, scale};
    cubes = blocks.cubes();
    const VisibleValues visible{scene, transferTables(scene, scale), scale};
    marks = blocks.mark(visible, centredClipPlanes(scene, grid), grid);
  }

  VolumeGrid grid;
  Scene scene;
  CubeGrid cubes;
  std::vector<std::uint8_t> marks;
};

const TransferFunction kUpperHalf{{{0.4, {255, 0, 0}, 0}, {0.9, {255, 0, 0}, 0.5}}, {}};

TEST_F(VisibleBlocksTest, CellsOutsideShowNothing) {
  std::mt19937 random{9};
  const auto upTo = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  int left = 0;
  for (int round = 0; round < 12; ++round) {
    const glm::ivec3 dims{60 + upTo(40), 50 + upTo(40), 40 + upTo(20)};
    const glm::dvec3 centre{upTo(dims.x), upTo(dims.y), upTo(dims.z)};
    test::ArraySource source{test::gridOf(dims), [&](glm::ivec3 i) {
                               return ballInNoise(i, centre, 20, static_cast<unsigned>(round));
                             }};
    prepare(source, kUpperHalf);
    std::vector<float> voxels(grid.voxelCount());
    source.load({glm::ivec3{0}, dims}, std::as_writable_bytes(std::span{voxels}));
    const auto at = [&](const glm::ivec3& v) {
      return voxels[static_cast<std::size_t>((v.z * dims.y + v.y) * dims.x + v.x)];
    };
    const auto shows = [&](const glm::ivec3& cell) {
      double highest = 0;
      for (int k = 0; k < 8; ++k)
        highest = std::max(highest, double{at(cell + glm::ivec3{k & 1, (k >> 1) & 1, k >> 2})});
      return scene.layers[0].transferFunction.largestExtinction(0, highest, 1) > 0;
    };
    const int reach = round % 4;
    // Two bricks; what shows in one of them reaches into the other.
    const int cut = 10 + upTo(dims.x - 20);
    for (const IndexBox& brick : {IndexBox{{0, 0, 0}, {cut, dims.y - 1, dims.z - 1}},
                                  IndexBox{{cut, 0, 0}, grid.cells()}}) {
      const IndexBox part = visiblePart(brick, marks, cubes, reach);
      EXPECT_TRUE(part.empty() || brick.contains(part));
      left += static_cast<int>(brick.count() - part.count());
      glm::ivec3 cell;
      for (cell.z = 0; cell.z < dims.z - 1; ++cell.z)
        for (cell.y = 0; cell.y < dims.y - 1; ++cell.y)
          for (cell.x = 0; cell.x < dims.x - 1; ++cell.x) {
            if (!shows(cell)) continue;
            const IndexBox near =
                intersection(brick, {cell - reach, cell + 1 + reach});  // its segments' middles
            if (!near.empty()) {
              ASSERT_TRUE(part.contains(near)) << round;
            }
          }
    }
  }
  EXPECT_GT(left, 12 * 50000) << "nothing was left out: the test shows nothing";
}

TEST_F(VisibleBlocksTest, NothingShownIsNoPart) {
  test::ArraySource source = test::smoothVolume(test::gridOf({40, 30, 20}));
  prepare(source, {{{2, {255, 0, 0}, 0}, {3, {255, 0, 0}, 1}}, {}});
  EXPECT_THAT(marks, testing::Each(0));
  EXPECT_TRUE(visiblePart({{0, 0, 0}, {39, 29, 19}}, marks, cubes, 2).empty());
}

TEST_F(VisibleBlocksTest, ClippedBlocksAreLeftOut) {
  test::ArraySource source{test::gridOf({65, 17, 17}), [](glm::ivec3) { return 0.8f; }};
  prepare(source, kUpperHalf, {{{1, 0, 0}, -34.5}});  // x >= 34.5: blocks from 32 on
  EXPECT_EQ(visiblePart({{0, 0, 0}, {64, 16, 16}}, marks, cubes, 0),
            (IndexBox{{31, 0, 0}, {64, 16, 16}}));
  EXPECT_EQ(visiblePart({{0, 0, 0}, {32, 16, 16}}, marks, cubes, 2),
            (IndexBox{{29, 0, 0}, {32, 16, 16}}));
}

TEST_F(VisibleBlocksTest, InfiniteVoxelsMayShowAnywhere) {
  // They look like the end of the finite values, which the blocks' ranges do not hold.
  test::ArraySource source{test::gridOf({49, 17, 17}), [](glm::ivec3 i) {
                             if (i.x == 0) return 1.0f;
                             return i.x == 40 ? std::numeric_limits<float>::infinity() : 0.0f;
                           }};
  prepare(source, kUpperHalf);
  EXPECT_THAT(marks, testing::Each(1));
}

TEST_F(VisibleBlocksTest, NanVoxelsAreNothing) {
  test::ArraySource source{test::gridOf({49, 17, 17}), [](glm::ivec3 i) {
                             return i.x < 10 ? 1.0f - 0.01f * static_cast<float>(i.x)
                                             : std::numeric_limits<float>::quiet_NaN();
                           }};
  prepare(source, kUpperHalf);
  const int width = cubes.size.x;
  ASSERT_EQ(cubes.cubeCells * width, 48);
  for (std::size_t i = 0; i < marks.size(); ++i)
    EXPECT_EQ(marks[i], static_cast<int>(i) % width * cubes.cubeCells < 10 ? 1 : 0) << i;
}

}  // namespace
}  // namespace burin::node
