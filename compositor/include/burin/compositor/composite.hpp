#pragma once

#include <optional>
#include <span>
#include <utility>

#include "burin/common/statistics.hpp"
#include "burin/compositor/mpi_executor.hpp"
#include "burin/compositor/subimage_operations.hpp"

namespace burin::compositor {

/// One rank's share of a composited frame.
template <PixelAlgebra A>
struct Share {
  FramePlan plan;
  /// Holds the finished pixels of this rank's region; nothing on a rank that took no part or was
  /// folded away. Its outcome is local: pass it to agree() before using the pixels.
  Participant<A> participant;
};

/// Collective. Composites one frame of any number of ranks. `order`: the ranks that may have drawn
/// something, front to back, the same on every rank. `mine`: what this rank drew; `drawing`: what
/// became of it. If drawing failed on any rank, CollectiveError is thrown on all of them before
/// pixels travel; see planFrame for the other errors. Ranks without active pixels take no part.
/// Adds to the statistics' composite phase; the participant has counted its messages.
template <PixelAlgebra A>
Share<A> composite(const Communicator& comm, const CompositeOptions& options,
                   std::span<const Rank> order, Subimage<typename A::Pixel> mine, Outcome drawing,
                   RankStatistics& statistics) {
  const PhaseTimer timer{statistics.phases[Phase::kComposite]};
  if (!drawing.failed) {
    drawing = attempt([&] {
      checkSubimage(mine);
      trim<A>(mine);
    });
  }
  if (drawing.failed) mine.active = {};
  Share<A> share;
  share.plan =
      planFrame(comm, options, order, {mine.frame, mine.active, std::move(drawing)}, A::kWireBytes);
  const FramePlan& plan = share.plan;
  if (!plan.isParticipant()) return share;
  share.participant = Participant<A>{plan.bounds, std::move(mine)};
  const Plan steps = makePlan(plan.schedule, plan.participants(), plan.all(), plan.self);
  executeOverMpi(comm, plan.ranks, steps, share.participant);
  return share;
}

/// Collective. composite() and then the gather to options.root: the finished frame there, nullopt
/// on the other ranks. Throws the same on all ranks, also if a message was damaged or memory ran
/// out on one of them on the way. Adds to the statistics' bytes, messages, composite and gather
/// phases.
template <PixelAlgebra A>
std::optional<Image<typename A::Pixel>> compositeToRoot(
    const Communicator& comm, const CompositeOptions& options, std::span<const Rank> order,
    Subimage<typename A::Pixel> mine, Outcome drawing, RankStatistics& statistics) {
  Share<A> share =
      composite<A>(comm, options, order, std::move(mine), std::move(drawing), statistics);
  const PhaseTimer timer{statistics.phases[Phase::kGather]};
  auto frame = gatherOverMpi(comm, share.plan, options.root, share.participant);
  const Traffic& traffic = share.participant.traffic();
  statistics.bytesSent += traffic.bytesSent;
  statistics.bytesReceived += traffic.bytesReceived;
  statistics.messagesSent += traffic.messagesSent;
  agree(comm, "compositing", share.participant.outcome());
  return frame;
}

}  // namespace burin::compositor
