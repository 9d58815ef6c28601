#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "burin/compositor/schedule.hpp"

namespace burin::compositor {

/// Swapping among any number of participants. The first `base` of them, in visibility order, swap
/// in rounds: in round r, groups of radices[r] whose distance is the product of the radices before,
/// so that the blocks already combined are neighbours. Each member keeps one part of the region
/// and sends the others theirs. The rest, fewer than base, do the same among themselves at the same
/// time with coarser pieces, each a run of base pieces, and send these to their owners at last.
///
/// Radix-k: Peterka, Goodell, Ross, Shen, Thakur, "A configurable algorithm for parallel
/// image-compositing applications", SC 2009; with radices 2: binary swap, Ma, Painter, Hansen,
/// Krogh, IEEE CG&A 14(4), 1994. The rest: Moreland, Kendall, Peterka, Huang, "An image compositing
/// solution at scale", SC 2011 ("telescoping"), here for any base instead of a power of two.
struct SwapLayout {
  std::vector<int> radices;
  int base = 1;                      ///< product of the radices
  std::unique_ptr<SwapLayout> rest;  ///< null if everybody is in the base

  SwapLayout(const ScheduleOptions& options, int participants);

  int pieceOf(int participant) const;     ///< -1: none
  int ownerOf(int piece) const;           ///< the other way round
  int restOwnerOf(int piece) const;       ///< who of the rest has that piece, if there is a rest
  int firstPieceOf(int restPiece) const;  ///< the base pieces of a piece of the rest: its first
};

/// The positions at which pieces begin, counted in whole pieces of some layout. The rest's are a
/// choice of the base's, looked up instead of copied: every participant asks for a few only.
class Cuts {
 public:
  explicit Cuts(std::span<const std::size_t> positions) : positions_{positions} {}
  Cuts ofRest(const SwapLayout& layout) const;
  Region pieces(int first, int count) const { return {at(first), at(first + count)}; }

 private:
  std::size_t at(int piece) const;

  std::span<const std::size_t> positions_;
  std::vector<const SwapLayout*> layouts_;  ///< outermost first
};

/// The plan of participant first + self, where the layout's participants begin at `first`.
Plan swapPlan(const SwapLayout& layout, const Cuts& cuts, int first, int self);

}  // namespace burin::compositor
