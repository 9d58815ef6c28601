#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "burin/compositor/coverage.hpp"
#include "burin/compositor/region.hpp"

namespace burin::compositor {

/// The sequence in which a frame's tiles are exchanged, and who ends up with which. Tiles nobody
/// has anything in are not in it.
struct TileAssignment {
  std::vector<std::uint32_t> tiles;  ///< by position
  /// Piece i of the schedule is [cuts[i], cuts[i + 1]); these tiles come first.
  std::vector<std::size_t> cuts;
  /// Per contributor the tiles that nobody else has anything in: they need no compositing.
  std::vector<Region> exclusive;

  Region contested() const { return {0, cuts.back()}; }
};

/// What assignTiles is told of a schedule; see schedule.hpp.
struct PieceMap {
  std::vector<int> holder;  ///< per contributor: the one that has its pixels after folding
  std::vector<int> piece;   ///< per contributor: the piece it owns in the end, -1 if none
  std::size_t pieces = 1;
};

/// Contributors that share at least one cell with another one.
std::vector<bool> contestedContributors(std::span<const Coverage> coverage);

/// Each cell goes to a contributor that has pixels in it (or to its holder), so that those pixels
/// need not travel, and of these to the one that has been given fewest pixels so far: what every
/// rank receives is balanced wherever the object is. Pure and the same on all ranks. `coverage`:
/// per contributor, front to back.
TileAssignment assignTiles(const TileGrid& grid, std::span<const Coverage> coverage,
                           const PieceMap& pieces);

/// For more ranks than can tell everybody their coverage: tiles in frame order, cut so that every
/// piece has the same sum of active pixels. `total`: per cell, over all ranks. Nothing is
/// exclusive.
TileAssignment balanceTiles(const TileGrid& grid, std::span<const std::int64_t> total,
                            std::size_t pieces, std::size_t contributors);

}  // namespace burin::compositor
