#pragma once

#include <optional>
#include <span>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/compositor/composite_options.hpp"
#include "burin/compositor/schedule.hpp"
#include "burin/compositor/tile_assignment.hpp"

namespace burin::compositor {

/// What one rank drew, as the others need to know it.
struct Contribution {
  std::int64_t activePixels = 0;
  Coverage coverage;  ///< zeros where coverages are not exchanged
};

/// Who does what in one frame; the same on every rank. Pure data: made from what all ranks told
/// each other.
struct FramePlan {
  TileGrid grid;
  TileAssignment assignment;
  std::vector<Rank> contributors;  ///< ranks with active pixels, front to back
  std::vector<int> participants;  ///< those with pixels where others have some: contributor indices
  ScheduleOptions schedule;
  std::vector<Coverage> coverage;  ///< per contributor; empty if coverages were not exchanged

  int contributorOf(Rank rank) const;        ///< -1: it drew nothing
  int participantOf(int contributor) const;  ///< -1: it need not composite
  Rank rankOf(int participant) const {
    return contributors[static_cast<std::size_t>(
        participants[static_cast<std::size_t>(participant)])];
  }
  PixelRect rectAt(std::size_t position) const { return grid.rect(assignment.tiles[position]); }
  /// What a contributor holds when the schedule is done, besides its exclusive region.
  Region owned(int contributor) const;
  /// A participant's steps, without messages that all ranks know to be empty.
  Plan planOf(int participant) const;
  /// Whether the message of a step carries nothing: known for schedules that send only what was
  /// drawn, when coverages were exchanged.
  bool isSilent(int sender, const Region& region) const;
};

/// More ranks than this do not tell everybody their coverage; see balanceTiles().
inline constexpr int kMostRanksWithCoverage = 64;

/// `order`: front to back. `total`: active pixels per cell over all ranks, used only if
/// coverages are not exchanged. `byRank`: of each rank of the communicator. Pure.
FramePlan makeFramePlan(const CompositeOptions& options, LinkClass link, const TileGrid& grid,
                        std::span<const Rank> order, std::span<const Contribution> byRank,
                        std::span<const std::int64_t> total, std::size_t pixelBytes);

}  // namespace burin::compositor
