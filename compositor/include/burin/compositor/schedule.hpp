#pragma once

#include <cstddef>
#include <vector>

#include "burin/compositor/region.hpp"

namespace burin::compositor {

/// Which pure function makes the schedule.
enum class ScheduleKind {
  kBinarySwap,  ///< log2 rounds of pairwise halving after folding to a power of two
  kDirectSend,  ///< everybody owns one piece and is sent everybody else's part of it at once
};

/// One thing a participant does. Participants are numbered 0 … n-1 front to back.
struct Step {
  enum class Kind {
    kSend,     ///< `region` of what I hold goes to `peer`; from now on it is no longer mine
    kReceive,  ///< `peer`'s pixels of `region` arrive and are combined; I hold only `region` after
  };
  Kind kind = Kind::kSend;
  int peer = 0;
  Region region;
  bool peerIsInFront = false;  ///< receive only: combine(theirs, mine), else combine(mine, theirs)
  friend bool operator==(const Step&, const Step&) = default;
};

/// One participant's steps, in order, and the region of finished pixels it holds after them (empty
/// if it was folded away). Sends do not wait for the receiver, receives wait for the sender.
struct Plan {
  std::vector<Step> steps;
  Region owned;
  friend bool operator==(const Plan&, const Plan&) = default;
};

/// A schedule is data: what every participant does. `plans` has one entry per participant.
struct Schedule {
  Region all;
  std::vector<Plan> plans;
};

/// The plan of participant `self` of `participants` (>= 1) that together hold `all`. Pure, so ranks
/// that agree on the arguments agree on the schedule without talking.
Plan makePlan(ScheduleKind kind, int participants, const Region& all, int self);

/// What `self` holds in the end: makePlan(…).owned.
Region ownedRegion(ScheduleKind kind, int participants, const Region& all, int self);

/// The plans of all participants: for executors in one process, checks and cost models.
Schedule makeSchedule(ScheduleKind kind, int participants, const Region& all);

}  // namespace burin::compositor
