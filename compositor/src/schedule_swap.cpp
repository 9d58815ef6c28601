#include "schedule_swap.hpp"

#include <cstdint>
#include <functional>
#include <numeric>

#include "burin/common/error.hpp"
#include "burin/compositor/schedule_radices.hpp"
#include "schedule_steps.hpp"

namespace burin::compositor {

namespace {

std::vector<int> radicesFor(const ScheduleOptions& options, int participants) {
  if (options.kind == ScheduleKind::kBinarySwap) return binarySwapRadices(participants);
  if (options.radices.empty()) return defaultRadices(participants);
  return fittedRadices(options.radices, participants);
}

/// number * numerator / denominator, rounded down, without overflow.
int scaled(int number, int numerator, int denominator) {
  return static_cast<int>(std::int64_t{number} * numerator / denominator);
}

/// The base's rounds. After them owned is the piece of `self`.
Plan basePlan(const SwapLayout& layout, const Cuts& cuts, int first, int self) {
  Plan plan;
  int begin = 0;
  int count = layout.base;
  int distance = 1;
  for (const int radix : layout.radices) {
    count /= radix;
    const int mine = self / distance % radix;
    const auto peer = [&](int member) { return first + self + (member - mine) * distance; };
    for (int i = 1; i < radix; ++i) {
      const int member = (mine + i) % radix;  // not all to the same one at first
      send(plan, peer(member), cuts.pieces(begin + member * count, count));
    }
    begin += mine * count;
    for (int member = 0; member < radix; ++member) {
      if (member == mine) continue;
      receive(plan, peer(member), cuts.pieces(begin, count), member < mine);
    }
    distance *= radix;
  }
  plan.owned = cuts.pieces(begin, 1);
  return plan;
}

}  // namespace

SwapLayout::SwapLayout(const ScheduleOptions& options, int participants)
    : radices{radicesFor(options, participants)},
      base{std::accumulate(radices.begin(), radices.end(), 1, std::multiplies{})} {
  if (participants > base) rest = std::make_unique<SwapLayout>(options, participants - base);
}

int SwapLayout::pieceOf(int participant) const {
  if (participant >= base) return -1;
  int piece = 0;
  for (const int radix : radices) {  // the first round decides the largest part of the region
    piece = piece * radix + participant % radix;
    participant /= radix;
  }
  return piece;
}

int SwapLayout::ownerOf(int piece) const {
  int participant = 0;
  for (auto radix = radices.rbegin(); radix != radices.rend(); ++radix) {
    participant = participant * *radix + piece % *radix;
    piece /= *radix;
  }
  return participant;
}

int SwapLayout::firstPieceOf(int restPiece) const {
  return scaled(restPiece, base, rest->base);
}

int SwapLayout::restOwnerOf(int piece) const {
  // The last rest piece that begins at or before: firstPieceOf(i) <= piece.
  const std::int64_t next = (std::int64_t{piece} + 1) * rest->base;
  return base + rest->ownerOf(static_cast<int>((next - 1) / base));
}

Cuts Cuts::ofRest(const SwapLayout& layout) const {
  Cuts result = *this;
  result.layouts_.push_back(&layout);
  return result;
}

std::size_t Cuts::at(int piece) const {
  for (auto layout = layouts_.rbegin(); layout != layouts_.rend(); ++layout) {
    piece = (*layout)->firstPieceOf(piece);
  }
  return positions_[static_cast<std::size_t>(piece)];
}

Plan swapPlan(const SwapLayout& layout, const Cuts& cuts, int first, int self) {
  if (self < layout.base) {
    Plan plan = basePlan(layout, cuts, first, self);
    if (layout.rest) {
      receive(plan, first + layout.restOwnerOf(layout.pieceOf(self)), plan.owned, false);
    }
    return plan;
  }
  const int inRest = self - layout.base;
  Plan plan = swapPlan(*layout.rest, cuts.ofRest(layout), first + layout.base, inRest);
  const int piece = layout.rest->pieceOf(inRest);
  if (piece >= 0) {
    const int last = layout.firstPieceOf(piece + 1);
    for (int i = layout.firstPieceOf(piece); i < last; ++i) {
      send(plan, first + layout.ownerOf(i), cuts.pieces(i, 1));
    }
  }
  plan.owned = {};
  return plan;
}

}  // namespace burin::compositor
