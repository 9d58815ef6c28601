#include "burin/compositor/tile_assignment.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace burin::compositor {

namespace {

std::size_t cellsOf(const TileGrid& grid) {
  const std::size_t step = std::max<std::size_t>(1, Coverage::tilesPerCell(grid));
  return (grid.count() + step - 1) / step;
}

/// Appends the tiles of `cells` to the sequence.
void append(std::vector<std::uint32_t>& tiles, const TileGrid& grid,
            std::span<const std::size_t> cells) {
  const std::size_t step = Coverage::tilesPerCell(grid);
  for (const std::size_t cell : cells) {
    for (std::size_t tile = cell * step; tile < std::min((cell + 1) * step, grid.count()); ++tile) {
      tiles.push_back(static_cast<std::uint32_t>(tile));
    }
  }
}

/// Coverage cell by cell: what is looked at together lies together.
class CellShares {
 public:
  CellShares(std::span<const Coverage> coverage, std::size_t cells)
      : contributors_{coverage.size()}, shares_(cells * coverage.size()) {
    for (std::size_t i = 0; i < contributors_; ++i) {
      for (std::size_t cell = 0; cell < cells; ++cell) {
        shares_[cell * contributors_ + i] = coverage[i][cell];
      }
    }
  }
  std::span<const std::uint8_t> of(std::size_t cell) const {
    return std::span{shares_}.subspan(cell * contributors_, contributors_);
  }

 private:
  std::size_t contributors_;
  std::vector<std::uint8_t> shares_;
};

/// Gives cells to owners one after the other.
class Owners {
 public:
  explicit Owners(const PieceMap& pieces)
      : pieces_{pieces}, received_(pieces.piece.size(), 0), held_(pieces.piece.size(), 0) {}

  /// The piece of a cell with these shares: of a contributor that holds something of it, and of
  /// those the one that will have received least. One that holds nothing is taken only if no other
  /// may own anything (serial gather).
  std::size_t give(std::span<const std::uint8_t> shares) {
    std::ranges::fill(held_, 0U);
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      held_[static_cast<std::size_t>(pieces_.holder[i])] += shares[i];
      total += shares[i];
    }
    const auto cost = [&](std::size_t i) {
      return std::pair{held_[i] == 0, received_[i] + total - held_[i]};
    };
    std::size_t best = shares.size();
    for (std::size_t i = 0; i < shares.size(); ++i) {
      if (pieces_.piece[i] < 0) continue;
      if (best == shares.size() || cost(i) < cost(best)) best = i;
    }
    received_[best] += total - held_[best];
    return static_cast<std::size_t>(pieces_.piece[best]);
  }

 private:
  const PieceMap& pieces_;
  std::vector<std::uint64_t> received_;  ///< 255ths of cells, per contributor
  std::vector<std::uint32_t> held_;      ///< likewise, of the cell at hand
};

}  // namespace

std::vector<bool> contestedContributors(std::span<const Coverage> coverage) {
  std::vector<bool> isContested(coverage.size(), false);
  std::array<std::uint8_t, Coverage::kCells> contributors{};
  for (const Coverage& one : coverage) {
    for (std::size_t cell = 0; cell < Coverage::kCells; ++cell) {
      contributors[cell] = static_cast<std::uint8_t>(contributors[cell] + (one[cell] != 0 ? 1 : 0));
    }
  }
  for (std::size_t i = 0; i < coverage.size(); ++i) {
    for (std::size_t cell = 0; cell < Coverage::kCells && !isContested[i]; ++cell) {
      isContested[i] = coverage[i][cell] != 0 && contributors[cell] > 1;
    }
  }
  return isContested;
}

TileAssignment assignTiles(const TileGrid& grid, std::span<const Coverage> coverage,
                           const PieceMap& pieces) {
  const std::size_t cells = cellsOf(grid);
  const CellShares shares{coverage, cells};
  std::vector<std::vector<std::size_t>> owned(pieces.pieces);  // cells per piece
  std::vector<std::vector<std::size_t>> exclusive(coverage.size());
  Owners owners{pieces};
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const auto here = shares.of(cell);
    std::size_t contributors = 0;
    std::size_t last = 0;  // the only one, if there is one
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (here[i] == 0) continue;
      ++contributors;
      last = i;
    }
    if (contributors == 1) {
      exclusive[last].push_back(cell);
    } else if (contributors > 1) {
      owned[owners.give(here)].push_back(cell);
    }
  }

  TileAssignment assignment;
  assignment.tiles.reserve(grid.count());
  for (const auto& piece : owned) {
    assignment.cuts.push_back(assignment.tiles.size());
    append(assignment.tiles, grid, piece);
  }
  assignment.cuts.push_back(assignment.tiles.size());
  for (const auto& alone : exclusive) {
    const std::size_t begin = assignment.tiles.size();
    append(assignment.tiles, grid, alone);
    assignment.exclusive.push_back({begin, assignment.tiles.size()});
  }
  return assignment;
}

TileAssignment balanceTiles(const TileGrid& grid, std::span<const std::int64_t> total,
                            std::size_t pieces, std::size_t contributors) {
  TileAssignment assignment;
  assignment.exclusive.resize(contributors);
  const std::size_t cells = cellsOf(grid);
  const std::int64_t sum = std::accumulate(
      total.begin(), total.begin() + static_cast<std::ptrdiff_t>(cells), std::int64_t{0});
  std::int64_t before = 0;
  assignment.cuts.push_back(0);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (total[cell] == 0) continue;
    // Piece i ends where i + 1 shares of the sum have come together.
    while (assignment.cuts.size() < pieces &&
           before * static_cast<std::int64_t>(pieces) >=
               sum * static_cast<std::int64_t>(assignment.cuts.size())) {
      assignment.cuts.push_back(assignment.tiles.size());
    }
    append(assignment.tiles, grid, std::span{&cell, 1});
    before += total[cell];
  }
  assignment.cuts.resize(pieces + 1, assignment.tiles.size());
  return assignment;
}

}  // namespace burin::compositor
