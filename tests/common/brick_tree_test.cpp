#include "burin/common/brick_tree.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "common/views.hpp"

namespace burin {
namespace {

using test::Random;

VolumeGrid gridOf(glm::ivec3 dims) {
  VolumeGrid grid;
  grid.dims = dims;
  return grid;
}

BrickTree build(glm::ivec3 dims, int owners, int bricks, BrickTree::Cost cost = {},
                BrickTree::TooLarge tooLarge = {}) {
  return BrickTree::build({gridOf(dims), owners, bricks, std::move(cost), std::move(tooLarge)});
}

/// Additive cost of a random field: the sum over the cells, by a table of prefix sums.
class CostField {
 public:
  template <typename CellCost>
  CostField(glm::ivec3 cells, CellCost cellCost) : size_{cells + 1} {
    sums_.resize(IndexBox{glm::ivec3{0}, size_}.count());
    for (int z = 1; z < size_.z; ++z) {
      for (int y = 1; y < size_.y; ++y) {
        for (int x = 1; x < size_.x; ++x) {
          sum(x, y, z) = cellCost(x - 1, y - 1, z - 1) + sum(x - 1, y, z) + sum(x, y - 1, z) +
                         sum(x, y, z - 1) - sum(x - 1, y - 1, z) - sum(x - 1, y, z - 1) -
                         sum(x, y - 1, z - 1) + sum(x - 1, y - 1, z - 1);
        }
      }
    }
  }
  double operator()(const IndexBox& b) const {
    const auto face = [&](int z) {
      return sum(b.hi.x, b.hi.y, z) - sum(b.lo.x, b.hi.y, z) - sum(b.hi.x, b.lo.y, z) +
             sum(b.lo.x, b.lo.y, z);
    };
    return std::max(0.0, face(b.hi.z) - face(b.lo.z));
  }

 private:
  std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>((z * size_.y + y) * size_.x + x);
  }
  double& sum(int x, int y, int z) { return sums_[index(x, y, z)]; }
  double sum(int x, int y, int z) const { return sums_[index(x, y, z)]; }
  glm::ivec3 size_;
  std::vector<double> sums_;
};

/// Every cell of the volume lies in exactly one brick, no brick is empty, owners' bricks follow one
/// another, and bricks are numbered from left to right.
void expectPartition(const BrickTree& tree) {
  const glm::ivec3 cells = tree.grid().cells();
  std::vector<int> seen(IndexBox{glm::ivec3{0}, cells}.count(), 0);
  int owner = 0;
  for (std::uint32_t i = 0; i < tree.brickCount(); ++i) {
    const IndexBox& box = tree.brickCells(BrickId{i});
    ASSERT_FALSE(box.empty());
    for (int z = box.lo.z; z < box.hi.z; ++z) {
      for (int y = box.lo.y; y < box.hi.y; ++y) {
        for (int x = box.lo.x; x < box.hi.x; ++x) {
          ++seen.at(static_cast<std::size_t>((z * cells.y + y) * cells.x + x));
        }
      }
    }
    const int next = tree.brickOwner(BrickId{i});
    ASSERT_TRUE(next == owner || next == owner + 1) << "brick " << i;
    owner = next;
  }
  EXPECT_EQ(owner, tree.ownerCount() - 1);
  EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }));
}

void expectConsistentNodes(const BrickTree& tree) {
  std::uint32_t nextBrick = 0;
  const auto nodes = tree.nodes();
  EXPECT_EQ(nodes[0].cells, (IndexBox{glm::ivec3{0}, tree.grid().cells()}));
  for (const BrickTree::Node& node : nodes) {  // stored parents first, left before right
    if (node.axis < 0) {
      EXPECT_EQ(node.brick, nextBrick++);
      EXPECT_GE(node.owner, 0);
      continue;
    }
    const BrickTree::Node& left = nodes[static_cast<std::size_t>(node.left)];
    const BrickTree::Node& right = nodes[static_cast<std::size_t>(node.right)];
    IndexBox leftCells = node.cells;
    IndexBox rightCells = node.cells;
    leftCells.hi[node.axis] = rightCells.lo[node.axis] = node.plane;
    EXPECT_EQ(left.cells, leftCells);
    EXPECT_EQ(right.cells, rightCells);
    if (node.owner >= 0) {
      EXPECT_EQ(left.owner, node.owner);
      EXPECT_EQ(right.owner, node.owner);
    }
  }
  EXPECT_EQ(nextBrick, tree.brickCount());
}

TEST(BrickTree, EveryCellLiesInOneBrick) {
  const std::vector<glm::ivec3> shapes{{1, 1, 1}, {2, 2, 2}, {4, 4, 1},    {3, 1, 1},   {4, 4, 4},
                                       {1, 7, 5}, {9, 2, 3}, {17, 16, 15}, {33, 5, 21}, {1, 1, 90}};
  for (const glm::ivec3& dims : shapes) {
    const auto cellCount = IndexBox{glm::ivec3{0}, gridOf(dims).cells()}.count();
    for (const int owners : {1, 2, 3, 4, 5, 6, 7, 8, 9, 13, 31, 64}) {
      for (const int bricks : {0, 1, 5, 8, 27, 64, 100}) {
        SCOPED_TRACE(fmt::format("dims {} {} {} owners {} bricks {}", dims.x, dims.y, dims.z,
                                 owners, bricks));
        const BrickTree tree = build(dims, owners, bricks);
        expectPartition(tree);
        expectConsistentNodes(tree);
        const auto usedOwners = std::min(static_cast<std::size_t>(owners), cellCount);
        EXPECT_EQ(static_cast<std::size_t>(tree.ownerCount()), usedOwners);
        EXPECT_EQ(tree.brickCount(),
                  std::min(cellCount, static_cast<std::size_t>(std::max(bricks, owners))));
        std::size_t total = 0;
        for (int owner = 0; owner < tree.ownerCount(); ++owner) {
          const auto mine = tree.bricksOf(owner);
          EXPECT_FALSE(mine.empty());
          total += mine.size();
        }
        EXPECT_EQ(total, tree.brickCount());
      }
    }
  }
}

TEST(BrickTree, BricksAreSharedEvenly) {
  for (const int owners : {2, 3, 5, 7, 13}) {
    for (const int bricks : {13, 14, 25, 64}) {
      const BrickTree tree = build({65, 49, 33}, owners, bricks);
      for (int owner = 0; owner < owners; ++owner) {
        const auto mine = static_cast<int>(tree.bricksOf(owner).size());
        EXPECT_GE(mine, bricks / owners);
        EXPECT_LE(mine, (bricks + owners - 1) / owners);
      }
    }
  }
}

TEST(BrickTree, ZeroCostSplitsByVolume) {
  const BrickTree tree = build({65, 33, 33}, 8, 0, [](const IndexBox&) { return 0.0; });
  for (std::uint32_t i = 0; i < 8; ++i) {
    EXPECT_EQ(tree.brickCells(BrickId{i}).count(), 64u * 32 * 32 / 8);
  }
}

TEST(BrickTree, ConcentratedCostIsSharedExactly) {
  // All cost in a cube of 8^3 cells in a corner: 4 owners can have a quarter each.
  const CostField cost{{64, 64, 64},
                       [](int x, int y, int z) { return x < 8 && y < 8 && z < 8 ? 1.0 : 0.0; }};
  const BrickTree tree = build({65, 65, 65}, 4, 0, cost);
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(cost(tree.brickCells(BrickId{i})), 128.0);
}

TEST(BrickTree, PlaneGoesToTheMiddleOfEmptySpace) {
  // Equal ends, nothing between: every plane in the gap balances, the middle one keeps bricks
  // compact.
  const CostField even{{64, 8, 8}, [](int x, int, int) { return x < 10 || x >= 54 ? 1.0 : 0.0; }};
  EXPECT_EQ(build({65, 9, 9}, 2, 0, even).nodes()[0].plane, 32);
  // 10 slices on the left, 14 on the right: 12 each lies inside the right part, the gap is no tie.
  const CostField uneven{{64, 8, 8}, [](int x, int, int) { return x < 10 || x >= 50 ? 1.0 : 0.0; }};
  EXPECT_EQ(build({65, 9, 9}, 2, 0, uneven).nodes()[0].plane, 52);
}

TEST(BrickTree, LongestWorldAxisIsSplit) {
  VolumeGrid grid = gridOf({65, 65, 17});
  EXPECT_EQ(BrickTree::build({grid, 2, 0, {}, {}}).nodes()[0].axis, 1);  // y before x where equal
  grid.spacing = {1, 1, 5};
  EXPECT_EQ(BrickTree::build({grid, 2, 0, {}, {}}).nodes()[0].axis, 2);
  grid.spacing = {1.5, 1, 5};
  EXPECT_EQ(BrickTree::build({grid, 2, 0, {}, {}}).nodes()[0].axis, 0);
}

TEST(BrickTree, AnotherAxisIsSplitWhereTheLongestCannotBalance) {
  // All cost in one slice across x: no plane of x parts it, any other axis parts it in halves.
  const CostField cost{{64, 16, 16}, [](int x, int, int) { return x == 5 ? 1.0 : 0.0; }};
  const BrickTree tree = build({65, 17, 17}, 2, 0, cost);
  EXPECT_EQ(tree.nodes()[0].axis, 2);
  EXPECT_EQ(tree.nodes()[0].plane, 8);
}

/// Smallest imbalance over all planes of one axis, by trying them all.
double bestImbalance(const CostField& cost, const IndexBox& cells, int axis, double share) {
  double best = 2;
  for (int plane = cells.lo[axis] + 1; plane < cells.hi[axis]; ++plane) {
    IndexBox left = cells;
    left.hi[axis] = plane;
    best = std::min(best, std::abs(cost(left) / cost(cells) - share));
  }
  return best;
}

TEST(BrickTree, PlanesBalanceCost) {
  Random random{20};
  for (int trial = 0; trial < 5; ++trial) {
    const glm::dvec3 hot = random.vector(5, 30);
    const CostField cost{{40, 36, 32}, [&](int x, int y, int z) {
                           const double distance = glm::length(glm::dvec3{x, y, z} - hot);
                           return std::exp(-distance / 6) + (random.integer(0, 9) == 0 ? 0.02 : 0);
                         }};
    for (const int owners : {2, 3, 5, 8, 13}) {
      const BrickTree tree = build({41, 37, 33}, owners, 0, cost);
      std::map<const BrickTree::Node*, int> ownersBelow;
      const auto nodes = tree.nodes();
      for (std::size_t i = nodes.size(); i-- > 0;) {
        const BrickTree::Node& node = nodes[i];
        if (node.axis < 0) {
          ownersBelow[&node] = 1;
          continue;
        }
        const auto* left = &nodes[static_cast<std::size_t>(node.left)];
        const auto* right = &nodes[static_cast<std::size_t>(node.right)];
        const int below = ownersBelow[&node] = ownersBelow[left] + ownersBelow[right];
        EXPECT_EQ(ownersBelow[left], (below + 1) / 2);
        const double share = static_cast<double>(ownersBelow[left]) / below;
        const double imbalance = std::abs(cost(left->cells) / cost(node.cells) - share);
        // Prefix sums of 46080 terms below 1 are good to 1e-10 of the cost of a node.
        EXPECT_NEAR(imbalance, bestImbalance(cost, node.cells, node.axis, share), 1e-8);
        for (int axis = 0; axis < 3; ++axis) {  // another axis only where it is worth it: 5 %
          EXPECT_LE(imbalance, bestImbalance(cost, node.cells, axis, share) + 0.05 + 1e-8);
        }
      }
    }
  }
}

TEST(BrickTree, TooLargeBricksAreSplitFurther) {
  const auto tooLarge = [](const IndexBox& cells) {
    return cells.count() > 500 || cells.size().x > 20;
  };
  for (const int owners : {1, 2, 3, 8}) {
    for (const int bricks : {0, 5, 100}) {
      const BrickTree tree = build({65, 17, 13}, owners, bricks, {}, tooLarge);
      expectPartition(tree);
      expectConsistentNodes(tree);
      EXPECT_EQ(tree.ownerCount(), owners);
      EXPECT_GE(tree.brickCount(), static_cast<std::size_t>(bricks));
      for (std::uint32_t i = 0; i < tree.brickCount(); ++i) {
        EXPECT_FALSE(tooLarge(tree.brickCells(BrickId{i})));
      }
    }
  }
}

TEST(BrickTree, AsksForFewCosts) {
  int calls = 0;
  const auto counted = [&](const IndexBox& box) {
    ++calls;
    return static_cast<double>(box.count());
  };
  const BrickTree tree = build({1025, 1025, 1025}, 64, 0, counted);
  EXPECT_EQ(tree.brickCount(), 64u);
  // Per inner node and axis three to five bisections of at most 10 halvings; trying all planes
  // would take 1023 per axis near the root.
  EXPECT_LE(calls, 63 * (1 + 3 * (5 * 11 + 8)));
}

TEST(BrickTree, SameRequestSameTree) {
  Random random{21};
  const CostField cost{{30, 30, 30}, [&](int, int, int) { return random.real(0, 1); }};
  const BrickTree a = build({31, 31, 31}, 7, 20, cost);
  const BrickTree b = build({31, 31, 31}, 7, 20, cost);
  EXPECT_TRUE(std::equal(a.nodes().begin(), a.nodes().end(), b.nodes().begin(), b.nodes().end()));
}

}  // namespace
}  // namespace burin
