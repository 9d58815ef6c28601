#include "burin/compositor/schedule_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "held_regions.hpp"
#include "messages_in_flight.hpp"
#include "plan_store.hpp"

namespace burin::compositor {

namespace {

constexpr int kNobody = -1;

/// Between rounds a participant holds the combination of one block wherever it holds anything: a
/// round leaves it with the round's region only.
struct State {
  State(HeldRegions all, Block alone) : held{std::move(all)}, block{alone} {}
  HeldRegions held;
  Block block;
  std::size_t next = 0;   ///< step it is at; within a round: the first not arrived yet
  std::size_t round = 0;  ///< first step of the round it is in
  bool isInRound = false;
  bool isAtEnd = false;
  int waitsFor = kNobody;  ///< whose message has not been sent yet
  Region owned;
  MessagesInFlight inbox;
};

class Simulation {
 public:
  explicit Simulation(const LazySchedule& schedule) : schedule_{schedule}, plans_{schedule} {
    states_.reserve(static_cast<std::size_t>(schedule.participants));
    for (int i = 0; i < schedule.participants; ++i) {
      states_.emplace_back(HeldRegions{schedule.all}, Block{i, i + 1});
      ready_.push_back(i);
    }
  }

  std::optional<std::string> run() {
    while (!ready_.empty() && problem_.empty()) {
      const int self = ready_.front();
      ready_.pop_front();
      advance(self);
    }
    if (problem_.empty()) checkEnds();
    if (problem_.empty()) checkCoverage();
    if (problem_.empty()) return std::nullopt;
    return problem_;
  }

 private:
  State& state(int participant) { return states_[static_cast<std::size_t>(participant)]; }

  void problem(int self, std::size_t step, std::string_view what) {
    problem_ = fmt::format("participant {}, step {}: {}", self, step, what);
  }

  /// As far as it gets without waiting.
  void advance(int self) {
    const Plan& plan = plans_.get(self);
    State& mine = state(self);
    mine.waitsFor = kNobody;
    while (mine.next < plan.steps.size() && mine.waitsFor == kNobody && problem_.empty()) {
      const Step& step = plan.steps[mine.next];
      if (!isValid(self, step)) return;
      if (step.kind == Step::Kind::kSend) {
        send(self, step);
      } else {
        await(self, plan.steps);
      }
    }
    mine.isAtEnd = mine.next == plan.steps.size();
    mine.owned = plan.owned;
  }

  bool isValid(int self, const Step& step) {
    const std::size_t at = state(self).next;
    if (step.peer < 0 || step.peer >= schedule_.participants || step.peer == self) {
      problem(self, at, "no such peer");
    } else if (step.region.empty()) {
      problem(self, at, "an empty region");
    } else if (step.kind == Step::Kind::kReceive && step.peerIsInFront != (step.peer < self)) {
      problem(self, at, "takes front for back");
    }
    return problem_.empty();
  }

  void send(int self, const Step& step) {
    State& mine = state(self);
    State& theirs = state(step.peer);
    if (!mine.held.take(step.region)) {
      return problem(self, mine.next, "sends pixels it does not hold");
    }
    theirs.inbox.add({self, step.region, mine.block});
    if (theirs.waitsFor == self) {
      theirs.waitsFor = kNobody;
      ready_.push_back(step.peer);
    }
    ++mine.next;
  }

  /// Goes on in a round until one has not sent yet or all have; then combines.
  void await(int self, const std::vector<Step>& steps) {
    State& mine = state(self);
    if (!mine.isInRound) mine.round = mine.next;
    mine.isInRound = true;
    const std::size_t end = roundEnd(steps, mine.round);
    for (; mine.next < end; ++mine.next) {
      const Step& step = steps[mine.next];
      if (!isValid(self, step)) return;
      const auto region = mine.inbox.regionFrom(step.peer);
      if (!region) {
        mine.waitsFor = step.peer;
        return;
      }
      if (*region != step.region) {
        return problem(self, mine.next, "receives a region it did not expect");
      }
    }
    mine.isInRound = false;
    combine(self, std::span{steps}.subspan(mine.round, end - mine.round));
  }

  void combine(int self, std::span<const Step> round) {
    State& mine = state(self);
    const Region& region = round.front().region;
    if (!mine.held.contains(region)) {
      return problem(self, mine.round, "combines pixels it does not hold");
    }
    if (!mine.held.isExactly(region)) {
      return problem(self, mine.round, "drops pixels that nobody was sent");
    }
    std::vector<std::pair<int, Block>> parts{{self, mine.block}};
    for (const Step& step : round) {
      if (!mine.inbox.regionFrom(step.peer)) {
        return problem(self, mine.round, "receives twice from one in a round");
      }
      parts.emplace_back(step.peer, mine.inbox.take(step.peer).block);
    }
    std::ranges::sort(parts, {}, &std::pair<int, Block>::first);
    for (std::size_t i = 1; i < parts.size(); ++i) {
      if (parts[i - 1].second.back != parts[i].second.front) {
        return problem(self, mine.round, "combines pixels that are no neighbours");
      }
    }
    mine.block = {parts.front().second.front, parts.back().second.back};
  }

  void checkEnds() {
    for (int self = 0; self < schedule_.participants; ++self) {
      const State& mine = state(self);
      if (!mine.isAtEnd) return problem(self, mine.next, "waits for ever");
    }
    for (int self = 0; self < schedule_.participants && problem_.empty(); ++self) checkEnd(self);
  }

  void checkEnd(int self) {
    const State& mine = state(self);
    if (!mine.inbox.empty()) {
      problem_ = fmt::format("participant {} sends to {} what is never received",
                             mine.inbox.anySender(), self);
    } else if (!mine.owned.empty() && !mine.held.contains(mine.owned)) {
      problem_ = fmt::format("participant {} does not hold what it owns", self);
    } else if (!mine.held.isExactly(mine.owned)) {
      problem_ = fmt::format("participant {} is left with pixels it does not own", self);
    } else if (!mine.owned.empty() && mine.block != Block{0, schedule_.participants}) {
      problem_ = fmt::format("participant {} owns pixels that are not complete", self);
    }
  }

  void checkCoverage() {
    std::vector<Region> owned;
    for (const State& state : states_) {
      if (!state.owned.empty()) owned.push_back(state.owned);
    }
    std::ranges::sort(owned, {}, &Region::begin);
    owned.push_back({schedule_.all.end, schedule_.all.end});
    std::size_t next = schedule_.all.begin;
    for (const Region& region : owned) {
      if (region.begin != next) {
        problem_ = fmt::format("position {} is owned by none or two", std::min(next, region.begin));
        return;
      }
      next = region.end;
    }
  }

  const LazySchedule& schedule_;
  PlanStore plans_;
  std::vector<State> states_;
  std::deque<int> ready_;  ///< first in, first out: rarely is anyone woken before all have sent
  std::string problem_;    ///< the first one found
};

}  // namespace

std::optional<std::string> scheduleProblem(const LazySchedule& schedule) {
  return Simulation{schedule}.run();
}

std::optional<std::string> scheduleProblem(const Schedule& schedule) {
  return scheduleProblem(lazySchedule(schedule));
}

}  // namespace burin::compositor
