#pragma once

#include <span>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/common/image.hpp"
#include "burin/compositor/schedule.hpp"

namespace burin::compositor {

/// How a frame is composited; the same on every rank.
struct CompositeOptions {
  ScheduleKind schedule = ScheduleKind::kBinarySwap;
  Rank root{0};  ///< where compositeToRoot gathers; need not have drawn anything
};

/// What all ranks know about a frame after one small all-gather.
struct FramePlan {
  ImageSize frame;
  PixelRect bounds;         ///< around all active rectangles
  std::vector<Rank> ranks;  ///< the participants, front to back: ranks with active pixels
  ScheduleKind schedule = ScheduleKind::kBinarySwap;
  int self = -1;  ///< index of this rank among the participants, -1 if it is none

  Region all() const { return {0, bounds.pixels()}; }
  bool isParticipant() const { return self >= 0; }
  int participants() const { return static_cast<int>(ranks.size()); }
  /// Region of finished pixels that a participant holds in the end.
  Region owned(int participant) const {
    return ownedRegion(schedule, participants(), all(), participant);
  }
};

/// One rank's contribution to the plan.
struct Announcement {
  ImageSize frame;
  PixelRect active;
  Outcome outcome;  ///< of drawing; of a failed rank nothing else counts
};

/// Collective. Throws on all ranks alike, before any of them waits for pixels: CollectiveError if a
/// rank failed; Error{kRank} if frame sizes, options or orders differ, if `order` names a rank
/// twice or none of the communicator's, if a rank outside `order` drew something, or if a message
/// would be too large for MPI. `pixelBytes`: of one pixel on the wire.
FramePlan planFrame(const Communicator& comm, const CompositeOptions& options,
                    std::span<const Rank> order, const Announcement& mine, std::size_t pixelBytes);

}  // namespace burin::compositor
