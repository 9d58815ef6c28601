#include "cost_estimate.hpp"

#include <gtest/gtest.h>

#include "drawing_cost.hpp"
#include "support/mpi_test.hpp"
#include "support/scenes.hpp"
#include "visible_blocks.hpp"

namespace burin::node {
namespace {

TEST(CostEstimate, CountsVisibleBlocksAndAddsUp) {
  // Dense material where x < 20 of 60 voxels: visible blocks are those that touch it.
  const VolumeGrid grid = test::gridOf({60, 37, 50});
  test::ArraySource source{grid, [](glm::ivec3 i) { return i.x < 20 ? 0.6f : 0.0f; }};
  Scene scene = test::sceneWithStyle("plain");
  resolveScene(scene, {grid, false});
  const VolumeSurvey survey = surveyVolume(test::world(), source, {});
  const ValueScale scale = valueScaleOf(VoxelType::kF32, survey);
  const VisibleBlocks blocks{survey, scale};
  const VisibleValues visible{scene, transferTables(scene, scale), scale};
  const std::vector<std::uint8_t> marks = blocks.mark(visible, {}, grid);
  DrawnBlocks drawn;
  drawn.grid = grid;
  drawn.cubes = blocks.cubes();
  drawn.marks = marks;
  drawn.stepVoxels = 0.5;
  const CostEstimate cost = DrawingCost{drawn}.unhidden();
  const glm::ivec3 cells = grid.cells();
  // Voxel 19 is the last dense one: blocks up to [16,20) show, [20,59) do not. Those are leapt
  // over from half a block before their end, and from as many blocks more as lie between.
  const double section = double{1} * cells.y * cells.z;
  double leaps = 0;
  for (int block = 0; block < 10; ++block) leaps += (block < 9 ? 4 : 3) * 0.5 / (4 * (block + 0.5));
  EXPECT_NEAR(cost({{0, 0, 0}, cells}), section * (20 + leaps), 1e-5 * section);
  EXPECT_NEAR(cost({{0, 0, 0}, {8, cells.y, cells.z}}), section * 8, 1e-6);
  // Additive over any cut.
  for (const int x : {1, 17, 33, 58})
    for (const int z : {5, 31, 48}) {
      const IndexBox low{{0, 3, 0}, {x, 20, z}};
      const IndexBox high{{x, 3, 0}, {59, 20, z}};
      EXPECT_NEAR(cost(low) + cost(high), cost({{0, 3, 0}, {59, 20, z}}), 1e-6);
    }
}

}  // namespace
}  // namespace burin::node
