#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "burin/compositor/frame_plan.hpp"
#include "burin/compositor/participant.hpp"
#include "burin/compositor/pending_send.hpp"

namespace burin::compositor {

/// Carries out one participant's plan over MPI. Collective over the participants; `ranks` are
/// theirs, front to back. Sends do not wait, and the next receive is always posted before the sends
/// in front of it, so that messages travel while pixels are encoded and combined. Throws
/// Error{kRank} only if MPI itself fails; what happens to pixels is in the participant's outcome.
template <PixelAlgebra A>
void executeOverMpi(const Communicator& comm, std::span<const Rank> ranks, const Plan& plan,
                    Participant<A>& participant) {
  const auto rankOf = [&](const Step& step) { return ranks[static_cast<std::size_t>(step.peer)]; };
  const auto isReceive = [](const Step& step) { return step.kind == Step::Kind::kReceive; };
  const auto largest = [](const Step& step) {
    return shareBytes(step.region.pixels(), A::kWireBytes);
  };
  std::size_t bufferBytes = 0;
  for (const Step& step : plan.steps) {
    if (isReceive(step)) bufferBytes = std::max(bufferBytes, largest(step));
  }
  MessageBuffer buffer{bufferBytes};
  MPI_Request receiving = MPI_REQUEST_NULL;
  const auto postNextReceive = [&](auto from) {
    const auto next = std::find_if(from, plan.steps.end(), isReceive);
    if (next == plan.steps.end()) return;
    receiving = beginReceive(comm, rankOf(*next), Tag::kSwap, buffer.bytes().first(largest(*next)));
  };

  std::vector<PendingSend> sends;
  postNextReceive(plan.steps.begin());
  for (auto step = plan.steps.begin(); step != plan.steps.end(); ++step) {
    if (isReceive(*step)) {
      participant.receive(*step, rankOf(*step), finishReceive(receiving, buffer.bytes()));
      postNextReceive(std::next(step));
    } else {
      sends.emplace_back(comm, rankOf(*step), Tag::kSwap, participant.encode(step->region));
    }
  }
  participant.finish(plan.owned);
  for (PendingSend& send : sends) send.wait();
}

/// Collective over the communicator. Brings the finished regions to `root` and returns the frame
/// there, nullopt elsewhere. Pixels nobody drew are the identity.
template <PixelAlgebra A>
std::optional<Image<typename A::Pixel>> gatherOverMpi(const Communicator& comm,
                                                      const FramePlan& plan, Rank root,
                                                      Participant<A>& participant) {
  if (comm.rank() != root) {
    if (!plan.isParticipant() || plan.owned(plan.self).empty()) return std::nullopt;
    PendingSend{comm, root, Tag::kGather, participant.encode(plan.owned(plan.self))}.wait();
    return std::nullopt;
  }
  struct Incoming {
    Rank sender;
    Region region;
    MessageBuffer buffer;
    MPI_Request request;
  };
  std::vector<Incoming> incoming;
  for (int i = 0; i < plan.participants(); ++i) {
    const Region region = plan.owned(i);
    if (i == plan.self || region.empty()) continue;
    const Rank sender = plan.ranks[static_cast<std::size_t>(i)];
    MessageBuffer buffer{shareBytes(region.pixels(), A::kWireBytes)};
    const MPI_Request request = beginReceive(comm, sender, Tag::kGather, buffer.bytes());
    incoming.push_back({sender, region, std::move(buffer), request});
  }
  Image<typename A::Pixel> frame{plan.frame};
  if (A::identity() != typename A::Pixel{}) std::ranges::fill(frame.pixels(), A::identity());
  if (plan.isParticipant()) participant.image().pasteInto(frame);
  for (Incoming& share : incoming) {
    const auto message = finishReceive(share.request, share.buffer.bytes());
    participant.accept(share.sender, message,
                       [&] { pasteMessage<A>(message, plan.bounds, share.region, frame); });
  }
  return frame;
}

}  // namespace burin::compositor
