#pragma once

#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "burin/compositor/participant.hpp"

namespace burin::compositor {

/// Runs a schedule in this process, participant after participant, with the messages that ranks
/// would exchange: the same bytes and, bit for bit, the same pixels as over MPI. For tests and for
/// counting what a schedule would cost on any number of ranks. Deterministic.
/// `images` has one subimage per participant, front to back, active inside `bounds`.
template <PixelAlgebra A>
std::vector<Participant<A>> executeInProcess(const Schedule& schedule, const PixelRect& bounds,
                                             std::vector<Subimage<typename A::Pixel>> images) {
  BURIN_CHECK_EQ(schedule.plans.size(), images.size());
  std::vector<Participant<A>> participants;
  for (auto& image : images) participants.emplace_back(bounds, std::move(image));

  std::map<std::pair<int, int>, std::deque<MessageBuffer>> underway;  // by sender and receiver
  std::vector<std::size_t> next(participants.size(), 0);
  /// Runs one participant as far as it gets; returns whether it did anything.
  const auto advance = [&](std::size_t i) {
    const auto& steps = schedule.plans[i].steps;
    const int self = static_cast<int>(i);
    const std::size_t start = next[i];
    for (; next[i] < steps.size(); ++next[i]) {
      const Step& step = steps[next[i]];
      if (step.kind == Step::Kind::kSend) {
        underway[{self, step.peer}].push_back(participants[i].encode(step.region));
        continue;
      }
      auto& queue = underway[{step.peer, self}];
      if (queue.empty()) break;
      participants[i].receive(step, Rank{step.peer}, queue.front().bytes());
      queue.pop_front();
    }
    return next[i] > start;
  };
  for (bool hasMoved = true; hasMoved;) {
    hasMoved = false;
    for (std::size_t i = 0; i < participants.size(); ++i) hasMoved = advance(i) || hasMoved;
  }
  for (std::size_t i = 0; i < participants.size(); ++i) {
    BURIN_CHECK_EQ(next[i], schedule.plans[i].steps.size());  // else the schedule is unsound
    participants[i].finish(schedule.plans[i].owned);
  }
  return participants;
}

/// The frame that the finished participants hold together.
template <PixelAlgebra A>
Image<typename A::Pixel> assemble(const std::vector<Participant<A>>& participants,
                                  ImageSize frame) {
  Image<typename A::Pixel> image{frame};
  std::ranges::fill(image.pixels(), A::identity());
  for (const auto& participant : participants) participant.image().pasteInto(image);
  return image;
}

}  // namespace burin::compositor
