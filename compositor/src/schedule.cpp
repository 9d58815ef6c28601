#include "burin/compositor/schedule.hpp"

#include <bit>

#include "burin/common/error.hpp"

namespace burin::compositor {

namespace {

Step send(int peer, const Region& region) {
  return {Step::Kind::kSend, peer, region, false};
}

Step receive(int peer, const Region& region, bool peerIsInFront) {
  return {Step::Kind::kReceive, peer, region, peerIsInFront};
}

/// Folding keeps one of two neighbours in visibility order for the first `pairs` pairs, so that a
/// power of two positions is left, in visibility order still.
struct Fold {
  int positions;  ///< largest power of two <= participants
  int pairs;      ///< participants beyond that

  explicit Fold(int participants)
      : positions{static_cast<int>(std::bit_floor(static_cast<unsigned>(participants)))},
        pairs{participants - positions} {}
  bool isFoldedAway(int participant) const {
    return participant < 2 * pairs && participant % 2 == 1;
  }
  bool hasFoldedNeighbour(int participant) const {
    return participant < 2 * pairs && participant % 2 == 0;
  }
  int position(int participant) const {
    return participant < 2 * pairs ? participant / 2 : participant - pairs;
  }
  int participant(int position) const { return position < pairs ? 2 * position : position + pairs; }
};

/// Ma, Painter, Hansen, Krogh, "Parallel volume rendering using binary-swap compositing", IEEE CG&A
/// 14(4), 1994. Pairs of growing distance: after round k a position holds 2^-k of the pixels,
/// combined over the 2^k neighbouring positions of its group, so the two groups that meet in the
/// next round are neighbours, the lower one in front.
Plan binarySwapPlan(int participants, const Region& all, int self) {
  const Fold fold{participants};
  Plan plan;
  if (fold.isFoldedAway(self)) {
    if (!all.empty()) plan.steps.push_back(send(self - 1, all));
    return plan;
  }
  if (fold.hasFoldedNeighbour(self) && !all.empty()) {
    plan.steps.push_back(receive(self + 1, all, false));
  }
  const int position = fold.position(self);
  plan.owned = all;
  for (int distance = 1; distance < fold.positions; distance *= 2) {
    const bool isLower = (position & distance) == 0;
    const int peer = fold.participant(position ^ distance);
    const Region first = piece(plan.owned, 0, 2);
    const Region second = piece(plan.owned, 1, 2);
    const Region& kept = isLower ? first : second;
    const Region& given = isLower ? second : first;
    if (!given.empty()) plan.steps.push_back(send(peer, given));
    if (!kept.empty()) plan.steps.push_back(receive(peer, kept, !isLower));
    plan.owned = kept;
  }
  return plan;
}

Region directSendPiece(int participants, const Region& all, int index) {
  return piece(all, static_cast<std::size_t>(index), static_cast<std::size_t>(participants));
}

/// Hsu, "Segmented ray casting for data parallel volume rendering", Parallel Rendering Symposium
/// 1993. Received from the neighbours outward, so that what is combined is always consecutive.
Plan directSendPlan(int participants, const Region& all, int self) {
  Plan plan;
  for (int i = 1; i < participants; ++i) {
    const int peer = (self + i) % participants;  // not all to the same one at first
    const Region given = directSendPiece(participants, all, peer);
    if (!given.empty()) plan.steps.push_back(send(peer, given));
  }
  plan.owned = directSendPiece(participants, all, self);
  if (plan.owned.empty()) return plan;
  for (int peer = self - 1; peer >= 0; --peer) {
    plan.steps.push_back(receive(peer, plan.owned, true));
  }
  for (int peer = self + 1; peer < participants; ++peer) {
    plan.steps.push_back(receive(peer, plan.owned, false));
  }
  return plan;
}

}  // namespace

Plan makePlan(ScheduleKind kind, int participants, const Region& all, int self) {
  BURIN_CHECK(participants >= 1 && self >= 0 && self < participants);
  return kind == ScheduleKind::kBinarySwap ? binarySwapPlan(participants, all, self)
                                           : directSendPlan(participants, all, self);
}

Region ownedRegion(ScheduleKind kind, int participants, const Region& all, int self) {
  return kind == ScheduleKind::kBinarySwap ? binarySwapPlan(participants, all, self).owned
                                           : directSendPiece(participants, all, self);
}

Schedule makeSchedule(ScheduleKind kind, int participants, const Region& all) {
  Schedule schedule{all, {}};
  for (int i = 0; i < participants; ++i) {
    schedule.plans.push_back(makePlan(kind, participants, all, i));
  }
  return schedule;
}

}  // namespace burin::compositor
