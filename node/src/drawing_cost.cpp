#include "drawing_cost.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "chessboard_distance.hpp"
#include "hiding.hpp"
#include "view_rays.hpp"

namespace burin::node {
namespace {

constexpr float kLeastOfMean = 0.25f;

/// Rays through a row of the picture: some for each of 64 blocks a side; fewer for each of several
/// views, as the work is that of the sum.
int raysAcross(std::size_t views) {
  return static_cast<int>(96 / std::sqrt(static_cast<double>(views)));
}

/// Per block the brick that has its first cell.
std::vector<std::uint32_t> bricksOf(const BrickTree& tree, const CubeGrid& cubes) {
  std::vector<std::uint32_t> bricks(IndexBox{glm::ivec3{0}, cubes.size}.count());
  const auto blocksBelow = [&](const glm::ivec3& cell) {
    return (cell + cubes.cubeCells - 1) / cubes.cubeCells;
  };
  for (std::uint32_t brick = 0; brick < tree.brickCount(); ++brick) {
    const IndexBox& cells = tree.brickCells(BrickId{brick});
    const glm::ivec3 first = blocksBelow(cells.lo);
    const glm::ivec3 end = blocksBelow(cells.hi);
    for (int z = first.z; z < end.z; ++z)
      for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) bricks[cubes.index({x, y, z})] = brick;
  }
  return bricks;
}

/// Per block the rounds that a ray takes in it, against one in a visible block.
std::vector<float> roundsOf(const DrawnBlocks& blocks) {
  std::vector<float> rounds;
  rounds.reserve(blocks.marks.size());
  for (const std::uint8_t distance : chessboardDistance(blocks.marks, blocks.cubes.size)) {
    // From somewhere in a block, half a block from its end on average, a ray leaps to where the
    // nearest visible one could begin.
    const double leapCells = blocks.cubes.cubeCells * (distance - 0.5);
    rounds.push_back(
        distance == 0 ? 1.0f : static_cast<float>(std::min(1.0, blocks.stepVoxels / leapCells)));
  }
  return rounds;
}

}  // namespace

DrawingCost::DrawingCost(DrawnBlocks blocks) : blocks_{std::move(blocks)} {
  for (const Camera& view : blocks_.views)
    rays_.push_back(raysPerCell(view, blocks_.cubes, blocks_.grid));
}

/// `rays`: per cell of each block, all views'.
CostEstimate DrawingCost::estimate(std::vector<float> rays) const {
  double sum = 0;
  double visible = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    sum += blocks_.marks[i] != 0 ? double{rays[i]} : 0;
    visible += blocks_.marks[i] != 0 ? 1 : 0;
  }
  const float least = visible > 0 ? kLeastOfMean * static_cast<float>(sum / visible) : 0;
  const std::vector<float> rounds = roundsOf(blocks_);
  for (std::size_t i = 0; i < rays.size(); ++i)
    rays[i] = blocks_.marks[i] != 0 ? std::max(rays[i], least) : rays[i] * rounds[i];
  return CostEstimate{rays, blocks_.cubes, blocks_.grid};
}

CostEstimate DrawingCost::unhidden() const {
  std::vector<float> rays(blocks_.marks.size(), rays_.empty() ? 1.0f : 0.0f);
  for (const std::vector<float>& ofView : rays_)
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i] += ofView[i];
  return estimate(std::move(rays));
}

CostEstimate DrawingCost::with(const BrickTree& tree) const {
  if (!isHiding()) return unhidden();
  const std::vector<std::uint32_t> bricks = bricksOf(tree, blocks_.cubes);
  std::vector<float> rays(blocks_.marks.size());
  const int across = std::max(1, raysAcross(rays_.size()));
  for (std::size_t view = 0; view < rays_.size(); ++view) {
    const std::vector<float> shares =
        shareNotHidden(blocks_.views[view], blocks_.grid,
                       {blocks_.cubes, blocks_.extinction, bricks}, blocks_.termination, across);
    for (std::size_t i = 0; i < rays.size(); ++i) rays[i] += shares[i] * rays_[view][i];
  }
  return estimate(std::move(rays));
}

}  // namespace burin::node
