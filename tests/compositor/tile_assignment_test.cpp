#include "burin/compositor/tile_assignment.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "test_images.hpp"

namespace burin::compositor {
namespace {

const TileGrid kGrid{ImageSize{1024, 1024}};

/// Everybody owns the piece of his number.
PieceMap ownPieces(std::size_t contributors) {
  PieceMap map;
  map.pieces = contributors;
  map.holder.resize(contributors);
  std::iota(map.holder.begin(), map.holder.end(), 0);
  map.piece = map.holder;
  return map;
}

/// Full tiles in columns and rows [x0, x1) x [y0, y1) of the grid's cells.
Coverage block(int x0, int y0, int x1, int y1) {
  Coverage coverage;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) coverage[static_cast<std::size_t>(y * kGrid.columns() + x)] = 255;
  }
  return coverage;
}

/// Every tile with anything in it is in the sequence once; pieces and exclusive regions divide it.
void expectWhole(const TileAssignment& assignment, std::span<const Coverage> coverage) {
  std::vector<int> hits(kGrid.count(), 0);
  for (const std::uint32_t tile : assignment.tiles) ++hits[tile];
  for (std::size_t tile = 0; tile < kGrid.count(); ++tile) {
    const bool isActive =
        std::ranges::any_of(coverage, [&](const Coverage& c) { return c[tile] != 0; });
    EXPECT_EQ(hits[tile], isActive ? 1 : 0);
  }
  std::size_t next = assignment.cuts.back();
  EXPECT_TRUE(std::ranges::is_sorted(assignment.cuts));
  for (const Region& region : assignment.exclusive) {
    EXPECT_EQ(region.begin, next);
    next = region.end;
  }
  EXPECT_EQ(next, assignment.tiles.size());
}

TEST(TileAssignment, TilesOfOneAloneAreExclusive) {
  const int columns = kGrid.columns();
  const Coverage coverage[] = {block(0, 0, columns / 2 + 1, 8), block(columns / 2, 0, columns, 8)};
  const auto assignment = assignTiles(kGrid, coverage, ownPieces(2));
  expectWhole(assignment, coverage);
  EXPECT_EQ(assignment.contested().length(), 8U);  // the column both have
  EXPECT_EQ(assignment.exclusive[0].length(), static_cast<std::size_t>(columns) / 2 * 8);
}

TEST(TileAssignment, AnObjectInOneCornerIsSharedByAll) {
  std::vector<Coverage> coverage(8, block(0, 0, 4, 4));
  const auto assignment = assignTiles(kGrid, coverage, ownPieces(8));
  expectWhole(assignment, coverage);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(assignment.cuts[i + 1] - assignment.cuts[i], 2U);  // 16 tiles, 8 owners
  }
}

// Nobody is given a tile that he has nothing in, and what each receives differs by no more than the
// largest tile's worth.
TEST(TileAssignment, OwnersHavePixelsThereAndAreBalanced) {
  test::Random random{1};
  std::vector<Coverage> coverage;
  for (int i = 0; i < 7; ++i) {
    const int width = kGrid.columns() / 2;
    const int height = kGrid.rows() / 2;
    const int x = test::below(random, width);
    const int y = test::below(random, height);
    coverage.push_back(block(x, y, x + width, y + height));
    for (std::size_t cell = 0; cell < Coverage::kCells; ++cell) {
      if (coverage.back()[cell] != 0)
        coverage.back()[cell] = static_cast<std::uint8_t>(1 + test::below(random, 255));
    }
  }
  const auto assignment = assignTiles(kGrid, coverage, ownPieces(7));
  expectWhole(assignment, coverage);
  for (std::size_t i = 0; i < 7; ++i) {
    for (std::size_t p = assignment.cuts[i]; p < assignment.cuts[i + 1]; ++p) {
      EXPECT_NE(coverage[i][assignment.tiles[p]], 0);
    }
  }
}

TEST(TileAssignment, FoldedContributorsOwnNothing) {
  const std::vector<Coverage> coverage(3, block(0, 0, 4, 9));
  PieceMap map = ownPieces(3);
  map.pieces = 2;
  map.holder = {0, 0, 2};
  map.piece = {0, -1, 1};
  const auto assignment = assignTiles(kGrid, coverage, map);
  expectWhole(assignment, coverage);
  EXPECT_EQ(assignment.cuts.size(), 3U);
  // Two thirds of the pixels are held by the first: what both receive is then equal if it owns
  // two thirds of the tiles.
  EXPECT_NEAR(static_cast<double>(assignment.cuts[1]), 24, 1);
}

TEST(TileAssignment, BalancedPiecesHaveEqualSums) {
  test::Random random{2};
  std::vector<std::int64_t> total(Coverage::kCells);
  for (auto& sum : total) sum = test::below(random, 3) == 0 ? test::below(random, 1000) : 0;
  const auto assignment = balanceTiles(kGrid, total, 5, 9);
  ASSERT_EQ(assignment.cuts.size(), 6U);
  ASSERT_EQ(assignment.exclusive.size(), 9U);
  const std::int64_t sum = std::accumulate(total.begin(), total.end(), std::int64_t{0});
  for (std::size_t i = 0; i < 5; ++i) {
    std::int64_t part = 0;
    for (std::size_t p = assignment.cuts[i]; p < assignment.cuts[i + 1]; ++p)
      part += total[assignment.tiles[p]];
    EXPECT_NEAR(static_cast<double>(part), static_cast<double>(sum) / 5, 1000);
  }
}

TEST(TileAssignment, NobodyDrewAnything) {
  const auto assignment = assignTiles(kGrid, {}, PieceMap{{}, {}, 0});
  EXPECT_TRUE(assignment.tiles.empty());
  EXPECT_TRUE(assignment.contested().empty());
  EXPECT_EQ(balanceTiles(kGrid, std::vector<std::int64_t>(Coverage::kCells, 0), 0, 0).cuts.size(),
            1U);
}

}  // namespace
}  // namespace burin::compositor
