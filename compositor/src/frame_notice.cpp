#include "burin/compositor/frame_notice.hpp"

#include <algorithm>
#include <cstring>

#include "burin/compositor/message_layout.hpp"

namespace burin::compositor {

namespace {

/// The fixed part of what goes through the all-gather. No padding: it is sent as bytes.
struct Head {
  std::uint64_t agreement;  ///< hash of what must be the same everywhere
  std::int64_t hasFailed;
  std::int64_t activePixels;
  MemoryNotice memory;
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

std::uint64_t agreementOf(const CompositeOptions& options, std::span<const Rank> order,
                          ImageSize frame, std::size_t pixelBytes) {
  Hash hash;
  hash.add(static_cast<int>(pixelBytes));
  hash.add(frame.width);
  hash.add(frame.height);
  hash.add(options.schedule ? static_cast<int>(options.schedule->kind) : -1);
  if (options.schedule) {
    hash.add(static_cast<int>(options.schedule->radices.size()));
    for (const int radix : options.schedule->radices) hash.add(radix);
  }
  hash.add(options.link ? static_cast<int>(*options.link) : -1);
  hash.add(static_cast<int>(options.packing));
  hash.add(options.isSharingMemory ? 1 : 0);
  hash.add(static_cast<int>(options.root));
  for (const Rank rank : order) hash.add(static_cast<int>(rank));
  return hash.value();
}

void checkAgreement(std::span<const Head> heads) {
  for (std::size_t rank = 1; rank < heads.size(); ++rank) {
    if (heads[rank].agreement != heads[0].agreement) {
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

/// No message holds more than every pixel of the frame, each in a run of its own.
void checkMessageSize(ImageSize frame, std::int64_t activePixels, std::size_t pixelBytes) {
  const std::size_t pixels =
      std::min(frame.pixels(), static_cast<std::size_t>(std::max<std::int64_t>(0, activePixels)));
  mpiCount(MessageLayout{TileGrid{frame}.count(), pixels, true}.payloadBegin() +
           pixels * pixelBytes);
}

/// Everybody's head, and coverage if it is told.
std::vector<Head> gatherHeads(const Communicator& comm, const AllGather& allGather,
                              const Head& mine, const Coverage& coverage,
                              std::vector<Coverage>& coverages) {
  const bool hasCoverage = comm.size() <= kMostRanksWithCoverage;
  const auto bytes = static_cast<std::size_t>(noticeBytes(comm.size()));
  std::vector<std::byte> notice(bytes);
  std::memcpy(notice.data(), &mine, sizeof mine);
  if (hasCoverage) std::memcpy(notice.data() + sizeof mine, &coverage, sizeof coverage);
  const auto all = allGather(notice);
  std::vector<Head> heads(static_cast<std::size_t>(comm.size()));
  coverages.resize(heads.size());
  for (std::size_t i = 0; i < heads.size(); ++i) {
    std::memcpy(&heads[i], all.data() + i * bytes, sizeof(Head));
    if (hasCoverage) {
      std::memcpy(&coverages[i], all.data() + i * bytes + sizeof(Head), sizeof(Coverage));
    }
  }
  return heads;
}

}  // namespace

std::int64_t noticeBytes(int ranks) {
  return static_cast<std::int64_t>(sizeof(Head) +
                                   (ranks <= kMostRanksWithCoverage ? sizeof(Coverage) : 0));
}

FrameNews exchangeNotices(const Communicator& comm, const AllGather& allGather,
                          const CompositeOptions& options, std::span<const Rank> order,
                          const FrameNotice& mine, Outcome drawing, std::size_t pixelBytes,
                          bool isWithinHost) {
  std::vector<Coverage> coverages;
  const auto heads = gatherHeads(comm, allGather,
                                 {agreementOf(options, order, mine.frame, pixelBytes),
                                  drawing.failed ? 1 : 0, mine.activePixels, mine.memory},
                                 mine.coverage, coverages);
  if (std::ranges::any_of(heads, [](const Head& head) { return head.hasFailed != 0; })) {
    agree(comm, "drawing", std::move(drawing));  // throws
  }
  checkAgreement(heads);
  const auto isInOrder = ranksOf(order, comm.size());
  FrameNews news;
  std::int64_t activePixels = 0;
  for (std::size_t rank = 0; rank < heads.size(); ++rank) {
    if (heads[rank].activePixels > 0 && !isInOrder[rank]) {
      fail(ExitCode::kRank, "visibility order: rank {} drew something but is not in it", rank);
    }
    activePixels += heads[rank].activePixels;
    news.contributions.push_back({heads[rank].activePixels, coverages[rank]});
    news.memories.push_back(heads[rank].memory);
  }
  if (!isWithinHost) checkMessageSize(mine.frame, activePixels, pixelBytes);
  if (comm.size() > kMostRanksWithCoverage) {
    for (std::size_t cell = 0; cell < Coverage::kCells; ++cell) {
      news.total.push_back(mine.coverage[cell]);
    }
    allReduce(comm, news.total, MPI_SUM);
  }
  return news;
}

}  // namespace burin::compositor
