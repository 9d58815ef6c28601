#include "burin/compositor/frame_plan.hpp"

#include <cstdint>

#include "burin/compositor/share_header.hpp"

namespace burin::compositor {

namespace {

/// What goes through the all-gather. No padding: it is sent as bytes.
struct Notice {
  std::uint64_t agreement;  ///< hash of what must be the same everywhere
  std::int32_t x0, y0, x1, y1;
  std::int64_t hasFailed;
};

/// FNV-1a over numbers: two ranks that call with different arguments must not go on, since their
/// messages would not match.
class Hash {
 public:
  void add(int number) { value_ = (value_ ^ static_cast<std::uint32_t>(number)) * 0x100000001b3U; }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

Notice noticeOf(const CompositeOptions& options, std::span<const Rank> order,
                const Announcement& mine) {
  Hash hash;
  hash.add(mine.frame.width);
  hash.add(mine.frame.height);
  hash.add(static_cast<int>(options.schedule));
  hash.add(static_cast<int>(options.root));
  for (const Rank rank : order) hash.add(static_cast<int>(rank));
  const PixelRect& r = mine.active;
  return {hash.value(), r.x0, r.y0, r.x1, r.y1, mine.outcome.failed ? 1 : 0};
}

PixelRect activeRect(const Notice& notice) {
  return {notice.x0, notice.y0, notice.x1, notice.y1};
}

void checkAgreement(std::span<const Notice> notices) {
  for (std::size_t rank = 1; rank < notices.size(); ++rank) {
    if (notices[rank].agreement != notices[0].agreement) {
      fail(ExitCode::kRank,
           "compositing: rank {} and rank 0 differ in frame size, options or visibility order",
           rank);
    }
  }
}

/// Which ranks `order` names. All ranks have the same order by now, so all of them throw.
std::vector<bool> ranksOf(std::span<const Rank> order, int size) {
  std::vector<bool> isNamed(static_cast<std::size_t>(size), false);
  for (const Rank rank : order) {
    const int index = static_cast<int>(rank);
    if (index < 0 || index >= size) {
      fail(ExitCode::kRank, "visibility order: rank 0 … {} expected, {} given", size - 1, index);
    }
    if (isNamed[static_cast<std::size_t>(index)]) {
      fail(ExitCode::kRank, "visibility order: rank {} is named twice", index);
    }
    isNamed[static_cast<std::size_t>(index)] = true;
  }
  return isNamed;
}

}  // namespace

FramePlan planFrame(const Communicator& comm, const CompositeOptions& options,
                    std::span<const Rank> order, const Announcement& mine, std::size_t pixelBytes) {
  const auto notices = allGather(comm, noticeOf(options, order, mine));
  for (const Notice& notice : notices) {
    if (notice.hasFailed != 0) agree(comm, "drawing", mine.outcome);  // throws
  }
  checkAgreement(notices);
  const auto isInOrder = ranksOf(order, comm.size());
  FramePlan plan{mine.frame, {}, {}, options.schedule, -1};
  for (std::size_t rank = 0; rank < notices.size(); ++rank) {
    const PixelRect rect = activeRect(notices[rank]);
    if (rect.empty()) continue;
    if (!isInOrder[rank]) {
      fail(ExitCode::kRank, "visibility order: rank {} drew something but is not in it", rank);
    }
    plan.bounds = boundingRect(plan.bounds, rect);
  }
  mpiCount(shareBytes(plan.bounds.pixels(), pixelBytes));
  for (const Rank rank : order) {
    if (activeRect(notices[static_cast<std::size_t>(rank)]).empty()) continue;
    if (rank == comm.rank()) plan.self = plan.participants();
    plan.ranks.push_back(rank);
  }
  return plan;
}

}  // namespace burin::compositor
