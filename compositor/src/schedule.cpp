#include "burin/compositor/schedule.hpp"

#include <memory>
#include <utility>

#include "burin/common/error.hpp"
#include "schedule_steps.hpp"
#include "schedule_swap.hpp"

namespace burin::compositor {

namespace {

bool isSwap(const ScheduleOptions& options) {
  return options.kind == ScheduleKind::kBinarySwap || options.kind == ScheduleKind::kRadixK;
}

/// Hsu, "Segmented ray casting for data parallel volume rendering", Parallel Rendering Symposium
/// 1993: one round.
Plan directSendPlan(int participants, const Cuts& cuts, int self) {
  Plan plan;
  plan.owned = cuts.pieces(self, 1);
  plan.steps.reserve(2 * static_cast<std::size_t>(participants));
  for (int i = 1; i < participants; ++i) {
    const int peer = (self + i) % participants;  // not all to the same one at first
    send(plan, peer, cuts.pieces(peer, 1));
  }
  for (int peer = 0; peer < participants; ++peer) {
    if (peer != self) receive(plan, peer, plan.owned, peer < self);
  }
  return plan;
}

Plan serialGatherPlan(int participants, const Cuts& cuts, int collector, int self) {
  Plan plan;
  const Region all = cuts.pieces(0, 1);
  if (self != collector) {
    send(plan, collector, all);
    return plan;
  }
  for (int peer = 0; peer < participants; ++peer) {
    if (peer != self) receive(plan, peer, all, peer < self);
  }
  plan.owned = all;
  return plan;
}

void checkArguments(const ScheduleOptions& options, int participants) {
  BURIN_CHECK(participants >= 1);
  BURIN_CHECK(options.kind != ScheduleKind::kSerialGather ||
              (options.collector >= 0 && options.collector < participants));
}

/// Makes plans with what does not depend on the participant worked out once.
std::function<Plan(int)> planner(const ScheduleOptions& options, int participants,
                                 std::span<const std::size_t> positions) {
  const Cuts cuts{positions};
  switch (options.kind) {
    case ScheduleKind::kDirectSend:
      return [=](int self) { return directSendPlan(participants, cuts, self); };
    case ScheduleKind::kSerialGather:
      return [=, collector = options.collector](int self) {
        return serialGatherPlan(participants, cuts, collector, self);
      };
    default:
      break;
  }
  return [layout = std::make_shared<const SwapLayout>(options, participants), cuts](int self) {
    return swapPlan(*layout, cuts, 0, self);
  };
}

}  // namespace

const char* scheduleName(ScheduleKind kind) {
  switch (kind) {
    case ScheduleKind::kBinarySwap:
      return "swap";
    case ScheduleKind::kRadixK:
      return "radix-k";
    case ScheduleKind::kDirectSend:
      return "direct";
    case ScheduleKind::kSerialGather:
      return "serial";
  }
  return "";
}

int pieceCount(const ScheduleOptions& options, int participants) {
  checkArguments(options, participants);
  if (isSwap(options)) return SwapLayout{options, participants}.base;
  return options.kind == ScheduleKind::kDirectSend ? participants : 1;
}

int pieceOf(const ScheduleOptions& options, int participants, int participant) {
  checkArguments(options, participants);
  BURIN_CHECK(participant >= 0 && participant < participants);
  if (isSwap(options)) return SwapLayout{options, participants}.pieceOf(participant);
  if (options.kind == ScheduleKind::kDirectSend) return participant;
  return participant == options.collector ? 0 : -1;
}

int holderOf(const ScheduleOptions& options, int participants, int participant) {
  checkArguments(options, participants);
  BURIN_CHECK(participant >= 0 && participant < participants);
  if (options.kind == ScheduleKind::kSerialGather) return options.collector;
  if (options.kind == ScheduleKind::kDirectSend) return participant;
  const SwapLayout layout{options, participants};
  if (participant < layout.base) return participant;
  const int rest = participants - layout.base;
  const int holder = holderOf(options, rest, participant - layout.base);
  return layout.ownerOf(layout.firstPieceOf(layout.rest->pieceOf(holder)));
}

std::vector<std::size_t> evenCuts(std::size_t positions, int pieces) {
  BURIN_CHECK(pieces >= 1);
  const auto count = static_cast<std::size_t>(pieces);
  std::vector<std::size_t> cuts(count + 1);
  for (std::size_t i = 0; i <= count; ++i) {
    cuts[i] = positions / count * i + positions % count * i / count;
  }
  return cuts;
}

Plan makePlan(const ScheduleOptions& options, int participants, std::span<const std::size_t> cuts,
              int self) {
  BURIN_CHECK_EQ(cuts.size(), static_cast<std::size_t>(pieceCount(options, participants)) + 1);
  BURIN_CHECK(self >= 0 && self < participants);
  return planner(options, participants, cuts)(self);
}

Schedule makeSchedule(const ScheduleOptions& options, int participants,
                      std::span<const std::size_t> cuts) {
  BURIN_CHECK_EQ(cuts.size(), static_cast<std::size_t>(pieceCount(options, participants)) + 1);
  const auto plan = planner(options, participants, cuts);
  Schedule schedule{{cuts.front(), cuts.back()}, {}};
  schedule.plans.reserve(static_cast<std::size_t>(participants));
  for (int self = 0; self < participants; ++self) schedule.plans.push_back(plan(self));
  return schedule;
}

LazySchedule lazySchedule(const ScheduleOptions& options, int participants,
                          std::vector<std::size_t> cuts) {
  BURIN_CHECK_EQ(cuts.size(), static_cast<std::size_t>(pieceCount(options, participants)) + 1);
  const auto kept = std::make_shared<const std::vector<std::size_t>>(std::move(cuts));
  return {participants,
          {kept->front(), kept->back()},
          [kept, plan = planner(options, participants, *kept)](int self) { return plan(self); }};
}

LazySchedule lazySchedule(const Schedule& schedule) {
  return {static_cast<int>(schedule.plans.size()), schedule.all,
          [&schedule](int self) { return schedule.plans[static_cast<std::size_t>(self)]; }};
}

std::size_t roundEnd(std::span<const Step> steps, std::size_t first) {
  std::size_t end = first;
  while (end < steps.size() && steps[end].kind == Step::Kind::kReceive &&
         steps[end].region == steps[first].region) {
    ++end;
  }
  return end;
}

}  // namespace burin::compositor
