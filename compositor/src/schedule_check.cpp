#include "burin/compositor/schedule_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

namespace burin::compositor {

namespace {

/// Pixels [begin, end) that hold the combination of participants [front, back).
struct Piece {
  std::size_t begin, end;
  int front, back;
};
/// Disjoint pieces by first pixel.
using Pieces = std::vector<Piece>;

/// The first piece that begins at or after `number`.
Pieces::iterator firstFrom(Pieces& pieces, std::size_t number) {
  return std::ranges::lower_bound(pieces, number, {}, &Piece::begin);
}

/// Makes `number` a border between pieces.
void splitAt(Pieces& pieces, std::size_t number) {
  auto it = firstFrom(pieces, number);
  if (it == pieces.begin() || std::prev(it)->end <= number) return;
  Piece upper = *std::prev(it);
  std::prev(it)->end = number;
  upper.begin = number;
  pieces.insert(it, upper);
}

/// Takes the pieces of `region` out; nullopt if not all of it is there.
std::optional<Pieces> take(Pieces& pieces, const Region& region) {
  splitAt(pieces, region.begin);
  splitAt(pieces, region.end);
  std::size_t next = region.begin;
  const auto first = firstFrom(pieces, region.begin);
  auto last = first;
  while (last != pieces.end() && last->begin == next && next < region.end) {
    next = last->end;
    ++last;
  }
  if (next != region.end) return std::nullopt;
  Pieces taken(first, last);
  pieces.erase(first, last);
  return taken;
}

/// Pixelwise combination of two lists that cover the same region; nullopt if some pixels are not
/// neighbours in visibility order.
std::optional<Pieces> combine(Pieces front, Pieces back) {
  for (const Piece& piece : Pieces{front}) splitAt(back, piece.begin);
  for (const Piece& piece : back) splitAt(front, piece.begin);
  for (std::size_t i = 0; i < front.size(); ++i) {
    if (front[i].back != back[i].front) return std::nullopt;
    front[i].back = back[i].back;
  }
  return front;
}

struct Message {
  Region region;
  Pieces pieces;
};

class Simulation {
 public:
  explicit Simulation(const Schedule& schedule) : schedule_{schedule}, next_(size(), 0) {
    for (std::size_t i = 0; i < size(); ++i) {
      const int self = static_cast<int>(i);
      Pieces held;
      if (!schedule.all.empty()) {
        held.push_back({schedule.all.begin, schedule.all.end, self, self + 1});
      }
      held_.push_back(std::move(held));
    }
  }

  std::optional<std::string> run() {
    for (bool hasMoved = true; hasMoved;) {
      hasMoved = false;
      for (std::size_t self = 0; self < size(); ++self) {
        while (next_[self] < steps(self).size()) {
          const auto result = advance(self);
          if (result == Result::kProblem) return problem_;
          if (result == Result::kWaits) break;
          hasMoved = true;
        }
      }
    }
    return problemAtEnd();
  }

 private:
  enum class Result { kDone, kWaits, kProblem };

  std::size_t size() const { return schedule_.plans.size(); }
  const std::vector<Step>& steps(std::size_t self) const { return schedule_.plans[self].steps; }

  Result problem(std::size_t self, const char* what) {
    problem_ = fmt::format("participant {}, step {}: {}", self, next_[self], what);
    return Result::kProblem;
  }

  Result advance(std::size_t self) {
    const Step& step = steps(self)[next_[self]];
    const auto peer = static_cast<std::size_t>(step.peer);
    if (step.peer < 0 || peer >= size() || peer == self) return problem(self, "no such peer");
    if (step.region.empty()) return problem(self, "an empty region");
    const Result result =
        step.kind == Step::Kind::kSend ? send(self, peer, step.region) : receive(self, peer, step);
    if (result == Result::kDone) ++next_[self];
    return result;
  }

  Result send(std::size_t self, std::size_t peer, const Region& region) {
    auto pieces = take(held_[self], region);
    if (!pieces) return problem(self, "sends pixels it does not hold");
    underway_[{self, peer}].push_back({region, std::move(*pieces)});
    return Result::kDone;
  }

  Result receive(std::size_t self, std::size_t peer, const Step& step) {
    auto& queue = underway_[{peer, self}];
    if (queue.empty()) return Result::kWaits;
    Message message = std::move(queue.front());
    queue.erase(queue.begin());
    if (message.region != step.region) return problem(self, "receives a region it did not expect");
    auto mine = take(held_[self], step.region);
    if (!mine) return problem(self, "combines pixels it does not hold");
    if (!held_[self].empty()) return problem(self, "drops pixels that nobody was sent");
    auto combined = step.peerIsInFront ? combine(std::move(message.pieces), std::move(*mine))
                                       : combine(std::move(*mine), std::move(message.pieces));
    if (!combined) return problem(self, "combines pixels that are no neighbours");
    held_[self] = std::move(*combined);
    return Result::kDone;
  }

  std::optional<std::string> problemAtEnd() {
    for (std::size_t self = 0; self < size(); ++self) {
      if (next_[self] < steps(self).size()) {
        return fmt::format("participant {}, step {}: waits for ever", self, next_[self]);
      }
    }
    for (const auto& [pair, queue] : underway_) {
      if (!queue.empty()) {
        return fmt::format("participant {} sends to {} what is never received", pair.first,
                           pair.second);
      }
    }
    std::map<std::size_t, std::size_t> owned;  // begin -> end
    for (std::size_t self = 0; self < size(); ++self) {
      const Region& region = schedule_.plans[self].owned;
      for (const Piece& piece : held_[self]) {
        if (piece.begin < region.begin || piece.end > region.end) {
          return fmt::format("participant {} is left with pixels it does not own", self);
        }
        if (piece.front != 0 || piece.back != static_cast<int>(size())) {
          return fmt::format("participant {} owns pixels that are not complete", self);
        }
      }
      if (region.empty()) continue;
      if (!take(held_[self], region)) {
        return fmt::format("participant {} does not hold what it owns", self);
      }
      if (!owned.emplace(region.begin, region.end).second) {
        return fmt::format("participant {} owns what another owns", self);
      }
    }
    return coverageProblem(owned);
  }

  std::optional<std::string> coverageProblem(const std::map<std::size_t, std::size_t>& owned) {
    std::size_t next = schedule_.all.begin;
    for (const auto& [begin, end] : owned) {
      if (begin != next) return fmt::format("pixels from {} on are owned by none or two", next);
      next = end;
    }
    if (next != schedule_.all.end) return fmt::format("pixels from {} on are owned by none", next);
    return std::nullopt;
  }

  const Schedule& schedule_;
  std::vector<Pieces> held_;
  std::vector<std::size_t> next_;  ///< step each participant is at
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Message>> underway_;
  std::string problem_;
};

}  // namespace

std::optional<std::string> scheduleProblem(const Schedule& schedule) {
  return Simulation{schedule}.run();
}

}  // namespace burin::compositor
