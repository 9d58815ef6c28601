#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "burin/compositor/region.hpp"

namespace burin::compositor {

/// Which pure function makes the schedule.
enum class ScheduleKind {
  kBinarySwap,    ///< rounds among 2 (3, 5, 7 where the count asks for it) participants
  kRadixK,        ///< the same in fewer, larger rounds
  kDirectSend,    ///< everybody owns one piece and is sent everybody else's part of it at once
  kSerialGather,  ///< one participant is sent everything: the baseline, best for small pictures
};

/// As options and tables call it: "swap", "radix-k", "direct", "serial".
const char* scheduleName(ScheduleKind kind);

/// How participants exchange.
struct ScheduleOptions {
  ScheduleKind kind = ScheduleKind::kBinarySwap;
  /// Radix-k only, each >= 2: how many participants exchange in the first, second … round. Any
  /// count works: what does not fit is cut off, what is missing is added. Empty: defaultRadices.
  std::vector<int> radices = {};
  int collector = 0;  ///< serial gather only: the participant that receives everything
  friend bool operator==(const ScheduleOptions&, const ScheduleOptions&) = default;
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
  bool peerIsInFront = false;  ///< receive only: peer < self
  friend bool operator==(const Step&, const Step&) = default;
};

/// One participant's steps, in order, and the region of finished pixels it holds after them (empty
/// if it owns none). Sends do not wait for the receiver. Consecutive receives of one region are a
/// *round*: it waits until all of them have arrived, then combines them and what it holds itself,
/// from the lowest participant (in front) to the highest.
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

/// A schedule whose plans are made when they are asked for: all of them together may not fit into
/// memory (direct send among 4096 has 16 million messages).
struct LazySchedule {
  int participants = 0;
  Region all;
  std::function<Plan(int self)> plan;
};

/// Number of pieces `all` is cut into: the number of participants that own one in the end.
int pieceCount(const ScheduleOptions& options, int participants);

/// The piece `participant` owns in the end, -1 if none. Each piece has one owner.
int pieceOf(const ScheduleOptions& options, int participants, int participant);

/// The owner that `participant`'s pixels go to: itself if it owns a piece; else one of those its
/// pixels are spread over, as good a place for them as any.
int holderOf(const ScheduleOptions& options, int participants, int participant);

/// `pieces` + 1 cuts of [0, positions) into pieces whose sizes differ by at most one.
std::vector<std::size_t> evenCuts(std::size_t positions, int pieces);

/// What participant `self` of `participants` (>= 1) does. `cuts`: pieceCount + 1 ascending
/// positions; piece i is [cuts[i], cuts[i+1]) and may be empty. There are no steps over empty
/// regions. Pure, so ranks that agree on the arguments agree on the schedule without talking.
Plan makePlan(const ScheduleOptions& options, int participants, std::span<const std::size_t> cuts,
              int self);

/// The plans of all participants: for tests, which change them.
Schedule makeSchedule(const ScheduleOptions& options, int participants,
                      std::span<const std::size_t> cuts);

/// The same, made when asked for: for checks and predictions of many participants.
LazySchedule lazySchedule(const ScheduleOptions& options, int participants,
                          std::vector<std::size_t> cuts);

/// A schedule that exists already. `schedule` must outlive the result.
LazySchedule lazySchedule(const Schedule& schedule);

/// End of the round that begins at `first`, a receive: the first step that is not part of it.
std::size_t roundEnd(std::span<const Step> steps, std::size_t first);

}  // namespace burin::compositor
