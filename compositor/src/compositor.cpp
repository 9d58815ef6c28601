#include "burin/compositor/compositor.hpp"

#include <algorithm>
#include <bit>

#include "burin/compositor/link_probe.hpp"

namespace burin::compositor {

namespace {

/// zstd at level 1, after colours are predicted, packs rendered pixels to between half and four
/// fifths: well below this rate of the link, the bytes saved are worth more than the time they
/// cost. Not tuned between 12 MB/s (measured: it pays) and a host's own memory (it does not).
constexpr double kPackBelowBytesPerSecond = 40e6;

constexpr std::size_t kPage = 4096;

}  // namespace

// Beside what was drawn: what was copied, what is combined in each round (a frame at most), and
// messages with pixels by value, two runs of two bytes and entries.
SharedLayout::SharedLayout(std::size_t pixels, std::size_t pixelBytes, int ranks)
    : part_{(pixels * pixelBytes + kPage - 1) / kPage * kPage},
      rest_{(3 + std::bit_width(static_cast<unsigned>(ranks))) * part_ + 16 * pixels +
            (std::size_t{1} << 20)} {}

std::span<std::byte> SharedLayout::canvas(std::span<std::byte> memory) const {
  return memory.size() < bytes() ? std::span<std::byte>{} : memory.subspan(part_, part_);
}

Compositor::Compositor(const Communicator& comm) : comm_{&comm}, hosts_{comm} {
  if (hosts_.hosts() > 1 || !hosts_.isSharing() || comm.size() > kMostRanksWithCoverage) return;
  exchangeMemory_.emplace(comm, comm.isRoot() ? HostExchange::bytes(comm.size()) : kPage);
  if (!exchangeMemory_->isSharing()) return;
  exchange_.emplace(exchangeMemory_->of(Rank{0}), comm.rank(), comm.size());
}

std::span<std::byte> Compositor::canvasBytes(const SharedLayout& layout, std::size_t bytes) {
  if (!hosts_.isSharing()) {
    ownCanvas_.resize(std::max(ownCanvas_.size(), layout.canvasBytes()));
    return std::span{ownCanvas_}.first(bytes);
  }
  share(layout);
  return layout.canvas(hosts_.own()).first(bytes);
}

void Compositor::share(const SharedLayout& layout) {
  hosts_.reserve(layout.bytes());
  // Parts of another layout lie across the frame.
  if (sharedBytes_ != layout.bytes()) lastFrame_ = {};
  sharedBytes_ = layout.bytes();
}

Keep Compositor::beginFrame(const CompositeOptions& options, const SharedLayout& layout,
                            std::span<const std::byte> drawn) {
  ownMemory_.reset();
  isSharing_ = options.isSharingMemory && hosts_.isSharing();
  if (!isSharing_) {
    if (options.root == comm_->rank()) {
      ownFrame_.resize(std::max(ownFrame_.size(), layout.canvasBytes()));
    }
    return Keep::kInPlace;
  }
  const bool isCanvas = !drawn.empty() && drawn.data() == layout.canvas(hosts_.own()).data();
  share(layout);
  if (options.root != comm_->rank()) lastFrame_ = {};
  sharedMemory_ = FrameMemory{layout.rest(hosts_.own())};
  return isCanvas ? Keep::kInPlace : Keep::kCopy;
}

std::span<std::byte> Compositor::frameBytes(const CompositeOptions& options, std::size_t bytes) {
  const bool isRoot = comm_->rank() == options.root;
  if (isSharing_) {
    const auto root = hosts_.of(options.root);
    return root.empty() ? root : root.first(bytes);
  }
  if (!isRoot) return {};
  return std::span{ownFrame_}.first(bytes);
}

const FramePlan& Compositor::agreeOnPlan(const CompositeOptions& options, const TileGrid& grid,
                                         std::span<const Rank> order, FrameNotice& notice,
                                         Outcome drawing, std::size_t pixelBytes) {
  const TraceSpan span{"plan"};
  notice.memory = hosts_.notice();
  const auto allGather = [&](std::span<const std::byte> mine) {
    return exchange_ ? exchange_->allGather(mine) : allGatherBytes(*comm_, mine);
  };
  const FrameNews news = exchangeNotices(*comm_, allGather, options, order, notice,
                                         std::move(drawing), pixelBytes, isSharing_ && exchange_);
  if (isSharing_ && hosts_.isNews(news.memories)) {
    try {
      collectively(*comm_, "sharing memory", [&] { hosts_.attach(news.memories); });
    } catch (const CollectiveError&) {
      hosts_.detach();
      throw;
    }
  }
  spaces_ = isSharing_ ? hosts_.spaces() : SharedSpaces{};
  isPacking_ = packs(options);
  const LinkClass link =
      options.link.value_or(hosts_.hosts() == 1 ? LinkClass::kSharedMemory : LinkClass::kFast);
  plan_ = makeFramePlan(options, link, grid, order, news.contributions, news.total, pixelBytes);
  return plan_;
}

std::vector<bool>& Compositor::leftInFrame(std::span<const std::byte> frame, const TileGrid& grid,
                                           const void* algebra) {
  if (lastFrame_.place != frame.data() || lastFrame_.grid != grid ||
      lastFrame_.algebra != algebra) {
    lastFrame_ = {frame.data(), grid, algebra, std::vector<bool>(grid.count(), true)};
  }
  return lastFrame_.isWritten;
}

void Compositor::endFrame(const Outcome& mine) {
  if (exchange_) {
    const std::byte hasFailed{mine.failed ? std::uint8_t{1} : std::uint8_t{0}};
    const auto all = exchange_->allGather({&hasFailed, 1});
    if (std::ranges::all_of(all, [](std::byte failed) { return failed == std::byte{0}; })) return;
  }
  agree(*comm_, "compositing", mine);
}

bool Compositor::packs(const CompositeOptions& options) {
  if (const auto declared = declaredPacking(options)) return *declared;
  if (hosts_.hosts() == 1) return false;
  if (!linkBytesPerSecond_) linkBytesPerSecond_ = measureLink(*comm_);
  return *linkBytesPerSecond_ < kPackBelowBytesPerSecond;
}

void Compositor::count(const Traffic& traffic, RankStatistics& statistics) {
  statistics.bytesSent += traffic.bytesSent;
  statistics.bytesReceived += traffic.bytesReceived;
  statistics.messagesSent += traffic.messagesSent;
  statistics.bytesToRoot += traffic.bytesToRoot;
  statistics.bytesByReference += traffic.bytesByReference;
  statistics.bytesPackedAway += traffic.bytesPackedAway;
}

}  // namespace burin::compositor
