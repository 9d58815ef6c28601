#pragma once

#include <functional>
#include <vector>

#include "burin/common/trace.hpp"
#include "burin/compositor/participant.hpp"

namespace burin::compositor {

/// How messages get from rank to rank: MpiFlow between processes, HostFlow between those of one
/// host, InProcessFlow between threads.
/// - send() does not wait; the message must stay until the frame ends for all ranks.
/// - receive() waits for one message of each sender and sets its `bytes`, which lie in what
///   `room(bytes)` gave and stay as long; two messages of one sender come in the order sent.
/// - receiveEach() likewise, but calls `use(index)` for each message as soon as it is there.
/// - finish() waits until everything sent has been taken.
template <typename F>
concept MessageFlow = requires(F flow, Rank rank, Tag tag, std::span<const std::byte> message,
                               std::span<Received> messages,
                               const std::function<std::span<std::byte>(std::size_t)>& room,
                               const std::function<void(std::size_t)>& use) {
  flow.send(rank, tag, message);
  flow.receive(tag, messages, room);
  flow.receiveEach(tag, messages, room, use);
  flow.finish();
};

/// Carries out a participant's part of the schedule. Sends do not wait, so messages travel while
/// pixels are combined. Throws Error{kRank} only if the flow itself fails; what happens to pixels
/// is in the participant's outcome.
template <PixelAlgebra A, MessageFlow F>
void execute(F& flow, int self, const Plan& steps, bool isPacked, Participant<A>& participant) {
  const FramePlan& plan = participant.plan();
  int number = 0;  // of the round
  for (std::size_t i = 0; i < steps.steps.size();) {
    const Step& step = steps.steps[i];
    if (step.kind == Step::Kind::kSend) {
      const Rank receiver = plan.rankOf(step.peer);
      flow.send(receiver, Tag::kSwap,
                participant.give(step.region, {receiver, Tag::kSwap, isPacked}));
      ++i;
      continue;
    }
    const TraceSpan span{"round", number++};
    std::vector<Received> round;
    for (const std::size_t end = roundEnd(steps.steps, i); i < end; ++i) {
      const int peer = steps.steps[i].peer;
      round.push_back({peer, plan.rankOf(peer), {}});
    }
    {
      const TraceSpan waiting{"receive"};
      flow.receive(Tag::kSwap, round, [&](std::size_t bytes) { return participant.room(bytes); });
    }
    participant.combine(step.region, self, round, i == steps.steps.size());
  }
}

/// Hands tiles to the root: puts them into its frame or sends them. Regions that are empty are not
/// sent.
template <PixelAlgebra A, MessageFlow F>
void handToRoot(F& flow, Rank root, const Region& region, bool isPacked,
                Participant<A>& participant) {
  if (region.empty()) return;
  if (participant.canDeposit()) {
    participant.deposit(region);
  } else {
    flow.send(root, Tag::kGather, participant.give(region, {root, Tag::kGather, isPacked}));
  }
}

/// Makes all pixels of the tiles that nobody has anything in the identity, except where they are
/// anyway: `isWritten`, by tile, says where earlier frames may have left something, and is updated.
template <PixelAlgebra A>
void clearUnusedTiles(const FramePlan& plan, ImageView<typename A::Pixel> frame,
                      std::vector<bool>& isWritten) {
  std::vector<bool> isUsed(plan.grid.count(), false);
  for (const std::uint32_t tile : plan.assignment.tiles) isUsed[tile] = true;
  for (std::size_t tile = 0; tile < isUsed.size(); ++tile) {
    if (!isUsed[tile] && isWritten[tile]) pasteTile<A>({}, plan.grid.rect(tile), frame);
  }
  isWritten = std::move(isUsed);
}

/// Local to the root. Puts what other hosts send into the frame. `puts(rank)`: whether a rank puts
/// its tiles there itself.
template <PixelAlgebra A, MessageFlow F, typename Puts>
void gatherAtRoot(F& flow, Participant<A>& participant, ImageView<typename A::Pixel> frame,
                  Puts&& puts) {
  const FramePlan& plan = participant.plan();
  std::vector<Received> expected;
  std::vector<Region> regions;
  for (std::size_t i = 0; i < plan.contributors.size(); ++i) {
    if (puts(plan.contributors[i])) continue;
    for (const Region& region : {plan.assignment.exclusive[i], plan.owned(static_cast<int>(i))}) {
      if (region.empty()) continue;
      expected.push_back({static_cast<int>(i), plan.contributors[i], {}});
      regions.push_back(region);
    }
  }
  const auto paste = [&](std::size_t position, const auto& tile) {
    pasteTile<A>(tile, plan.rectAt(position), frame);
  };
  flow.receiveEach(
      Tag::kGather, expected, [&](std::size_t bytes) { return participant.room(bytes); },
      [&](std::size_t index) {
        const Region& region = regions[index];
        std::size_t next = region.begin;
        for (const auto& placed : participant.decode(expected[index], region, Tag::kGather)) {
          for (; next < placed.position; ++next) paste(next, SparseTile<typename A::Pixel>{});
          paste(next++, placed.tile);
        }
        for (; next < region.end; ++next) paste(next, SparseTile<typename A::Pixel>{});
      });
}

/// A rank's whole part in a frame after the plan is known. `frame`: the root's on the root, without
/// pixels elsewhere; all pixels of the plan's tiles are written. `enterGather()` is called when
/// compositing is done.
template <PixelAlgebra A, MessageFlow F, typename EnterGather>
void runFrame(F& flow, const CompositeOptions& options, Rank rank, bool isPacked,
              const SharedSpaces& spaces, Participant<A>& participant,
              ImageView<typename A::Pixel> frame, EnterGather&& enterGather) {
  const FramePlan& plan = participant.plan();
  const int contributor = plan.contributorOf(rank);
  Region left;  // what is held when compositing is done
  if (contributor >= 0) {
    // Can travel while others are composited.
    const Region& exclusive = plan.assignment.exclusive[static_cast<std::size_t>(contributor)];
    handToRoot(flow, options.root, exclusive, isPacked, participant);
    const int self = plan.participantOf(contributor);
    const Plan steps = self >= 0 ? plan.planOf(self) : Plan{};
    if (self >= 0) execute(flow, self, steps, isPacked, participant);
    const bool isDeposited = participant.canDeposit() && !steps.steps.empty() &&
                             steps.steps.back().kind == Step::Kind::kReceive;
    if (!isDeposited) left = plan.owned(contributor);
  }
  enterGather();
  handToRoot(flow, options.root, left, isPacked, participant);
  if (rank == options.root) {
    gatherAtRoot(flow, participant, frame, [&](Rank sender) {
      return sender == rank || spaces.reaches(static_cast<int>(sender));
    });
  }
  flow.finish();
}

}  // namespace burin::compositor
