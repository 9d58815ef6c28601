#include "burin/compositor/frame_plan.hpp"

#include <algorithm>
#include <numeric>

namespace burin::compositor {

namespace {

/// The first index with `values[index] == value`, -1 if there is none.
template <typename T>
int indexOf(const std::vector<T>& values, const T& value) {
  const auto it = std::ranges::find(values, value);
  return it == values.end() ? -1 : static_cast<int>(it - values.begin());
}

/// Who takes part in the schedule and what it is.
struct Roles {
  std::vector<int> participants;
  ScheduleOptions schedule;
};

Roles rolesOf(const CompositeOptions& options, LinkClass link, const TileGrid& grid,
              const FramePlan& plan, std::int64_t activePixels, std::size_t pixelBytes) {
  Roles roles;
  if (plan.coverage.empty()) {
    roles.participants.resize(plan.contributors.size());
    std::iota(roles.participants.begin(), roles.participants.end(), 0);
  } else {
    const auto isContested = contestedContributors(plan.coverage);
    for (std::size_t i = 0; i < isContested.size(); ++i) {
      if (isContested[i]) roles.participants.push_back(static_cast<int>(i));
    }
  }
  if (options.schedule) {
    roles.schedule = *options.schedule;
  } else if (!roles.participants.empty()) {
    roles.schedule = chooseSchedule(static_cast<int>(roles.participants.size()),
                                    static_cast<std::size_t>(activePixels), grid.frame().pixels(),
                                    link, pixelBytes);
  }
  return roles;
}

PieceMap pieceMap(const FramePlan& plan) {
  const int participants = static_cast<int>(plan.participants.size());
  PieceMap map;
  map.pieces =
      participants == 0 ? 0 : static_cast<std::size_t>(pieceCount(plan.schedule, participants));
  if (plan.coverage.empty()) return map;  // pieces are cut by sums, not given to owners
  map.holder.resize(plan.contributors.size());
  std::iota(map.holder.begin(), map.holder.end(), 0);
  map.piece.assign(plan.contributors.size(), -1);
  for (int i = 0; i < participants; ++i) {
    const auto contributor =
        static_cast<std::size_t>(plan.participants[static_cast<std::size_t>(i)]);
    map.piece[contributor] = pieceOf(plan.schedule, participants, i);
    map.holder[contributor] =
        plan.participants[static_cast<std::size_t>(holderOf(plan.schedule, participants, i))];
  }
  return map;
}

}  // namespace

int FramePlan::contributorOf(Rank rank) const {
  return indexOf(contributors, rank);
}

int FramePlan::participantOf(int contributor) const {
  return indexOf(participants, contributor);
}

Region FramePlan::owned(int contributor) const {
  const int participant = participantOf(contributor);
  if (participant < 0) return {};
  const int piece = pieceOf(schedule, static_cast<int>(participants.size()), participant);
  if (piece < 0) return {};
  const auto index = static_cast<std::size_t>(piece);
  return {assignment.cuts[index], assignment.cuts[index + 1]};
}

Plan FramePlan::planOf(int participant) const {
  Plan plan =
      makePlan(schedule, static_cast<int>(participants.size()), assignment.cuts, participant);
  std::erase_if(plan.steps, [&](const Step& step) {
    return isSilent(step.kind == Step::Kind::kSend ? participant : step.peer, step.region);
  });
  return plan;
}

bool FramePlan::isSilent(int sender, const Region& region) const {
  const bool sendsWhatItDrew =
      schedule.kind == ScheduleKind::kDirectSend || schedule.kind == ScheduleKind::kSerialGather;
  if (!sendsWhatItDrew || coverage.empty()) return false;
  const Coverage& drawn =
      coverage[static_cast<std::size_t>(participants[static_cast<std::size_t>(sender)])];
  const std::size_t step = Coverage::tilesPerCell(grid);
  for (std::size_t position = region.begin; position < region.end; ++position) {
    if (drawn[assignment.tiles[position] / step] != 0) return false;
  }
  return true;
}

FramePlan makeFramePlan(const CompositeOptions& options, LinkClass link, const TileGrid& grid,
                        std::span<const Rank> order, std::span<const Contribution> byRank,
                        std::span<const std::int64_t> total, std::size_t pixelBytes) {
  FramePlan plan;
  plan.grid = grid;
  const bool hasCoverage = byRank.size() <= static_cast<std::size_t>(kMostRanksWithCoverage);
  std::int64_t activePixels = 0;
  const auto add = [&](Rank rank) {
    const Contribution& contribution = byRank[static_cast<std::size_t>(rank)];
    plan.contributors.push_back(rank);
    if (hasCoverage) plan.coverage.push_back(contribution.coverage);
    activePixels += contribution.activePixels;
  };
  for (const Rank rank : order) {
    if (byRank[static_cast<std::size_t>(rank)].activePixels > 0) add(rank);
  }
  Roles roles = rolesOf(options, link, grid, plan, activePixels, pixelBytes);
  if (roles.schedule.kind == ScheduleKind::kSerialGather && !roles.participants.empty()) {
    // The root collects, whether or not it drew: at the back, where nothing is as good as anywhere.
    int root = plan.contributorOf(options.root);
    if (root < 0) {
      root = static_cast<int>(plan.contributors.size());
      add(options.root);
    }
    if (indexOf(roles.participants, root) < 0) {
      roles.participants.push_back(root);
      std::ranges::sort(roles.participants);
    }
    roles.schedule.collector = indexOf(roles.participants, root);
  }
  plan.participants = std::move(roles.participants);
  plan.schedule = std::move(roles.schedule);
  const PieceMap pieces = pieceMap(plan);
  plan.assignment = hasCoverage
                        ? assignTiles(grid, plan.coverage, pieces)
                        : balanceTiles(grid, total, pieces.pieces, plan.contributors.size());
  return plan;
}

}  // namespace burin::compositor
