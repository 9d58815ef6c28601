#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "burin/common/statistics.hpp"
#include "burin/compositor/executor.hpp"
#include "burin/compositor/frame_notice.hpp"
#include "burin/compositor/host_exchange.hpp"
#include "burin/compositor/host_memory.hpp"
#include "burin/compositor/mpi_flow.hpp"

namespace burin::compositor {

/// How a rank divides the memory it shares: the finished frame (used on the root), what it draws,
/// and what is combined and told on the way. Pages are used only when written to.
class SharedLayout {
 public:
  /// `pixels`: of the frame. `ranks`: of the communicator.
  SharedLayout(std::size_t pixels, std::size_t pixelBytes, int ranks);
  std::size_t bytes() const { return 2 * part_ + rest_; }
  std::size_t canvasBytes() const { return part_; }
  /// Empty if `memory` is too small for the layout.
  std::span<std::byte> canvas(std::span<std::byte> memory) const;
  std::span<std::byte> rest(std::span<std::byte> memory) const { return memory.subspan(2 * part_); }

 private:
  std::size_t part_, rest_;
};

/// What the root's frame holds, so that pixels which are the identity already need not be cleared.
struct LastFrame {
  const std::byte* place = nullptr;
  TileGrid grid;
  const void* algebra = nullptr;  ///< address of its kAlgebraId
  std::vector<bool> isWritten;    ///< by tile
};
template <PixelAlgebra A>
inline constexpr char kAlgebraId{};

/// Merges the subimages of all ranks of a communicator, frame after frame, of any pixel type. Keeps
/// memory and what it learned of the hosts from frame to frame, so one is made and kept. All ranks
/// make it and call it alike; one thread each.
class Compositor {
 public:
  /// Collective. `comm` must outlive it.
  explicit Compositor(const Communicator& comm);

  /// Local. Room for `pixels` pixels (of the frame's at most) of a subimage of the next frame, of
  /// size `frame`, in memory that the other ranks of the host read in place: a subimage that is
  /// drawn here is never copied. Uninitialised. For a frame of another size than the one before,
  /// the memory may move: then earlier canvases and the last frame are gone.
  template <typename Pixel>
  std::span<Pixel> canvas(ImageSize frame, std::size_t pixels) {
    BURIN_CHECK(pixels <= frame.pixels());
    const std::span<std::byte> room =
        canvasBytes({frame.pixels(), sizeof(Pixel), comm_->size()}, pixels * sizeof(Pixel));
    return {reinterpret_cast<Pixel*>(room.data()), pixels};
  }

  /// Collective. Composites one frame of any number of ranks: the finished frame on options.root,
  /// valid until the next call, nullopt on the others. `order`: the ranks that may have drawn
  /// something, front to back, the same everywhere. `mine`: what this rank drew; `drawing`: what
  /// became of it.
  ///
  /// If drawing failed on any rank, CollectiveError is thrown on all of them before pixels travel;
  /// Error{kRank} on all of them if frame sizes, options or orders differ, if `order` names a rank
  /// twice or none of the communicator's, if a rank outside it drew something, if a message would
  /// be too large for MPI, and CollectiveError if a message was damaged or could not be made.
  /// Memory that runs out while a message is received is one rank's alone: std::bad_alloc, and the
  /// others wait in vain, so the program must end. Ranks without active pixels take no part. Adds
  /// to the statistics' active pixels, bytes, messages, composite and gather phases.
  template <PixelAlgebra A>
  std::optional<ImageView<const typename A::Pixel>> toRoot(
      const CompositeOptions& options, std::span<const Rank> order,
      const SubimageView<typename A::Pixel>& mine, Outcome drawing, RankStatistics& statistics) {
    using Pixel = typename A::Pixel;
    std::optional<PhaseTimer> timer{std::in_place, statistics.phases, Phase::kComposite};
    const bool isRoot = comm_->rank() == options.root;
    const TileGrid grid{mine.frame};
    SparseImage<Pixel> image;
    FrameNotice notice;
    if (!drawing.failed) {
      drawing = attempt([&] {
        checkSubimage(mine);
        const Keep keep = beginFrame(options, {mine.frame.pixels(), sizeof(Pixel), comm_->size()},
                                     std::as_bytes(mine.pixels));
        image = compress<A>(mine, grid, keep, memory().tiles());
        notice = FrameNotice{mine.frame, image, grid};
      });
    }
    const FramePlan& plan =
        agreeOnPlan(options, grid, order, notice, std::move(drawing), A::kMaxWireBytes);
    const std::span<std::byte> bytes = frameBytes(options, mine.frame.pixels() * sizeof(Pixel));
    const ImageView<Pixel> frame{
        mine.frame, {reinterpret_cast<Pixel*>(bytes.data()), bytes.size() / sizeof(Pixel)}};
    if (isRoot) clearUnusedTiles<A>(plan, frame, leftInFrame(bytes, grid, &kAlgebraId<A>));
    Participant<A> participant{plan, spaces_, image, frame, memory()};
    const auto run = [&](auto&& flow) {
      runFrame(flow, options, comm_->rank(), isPacking_, spaces_, participant, frame,
               [&] { timer.emplace(statistics.phases, Phase::kGather); });
    };
    if (isSharing_ && exchange_) {
      run(HostFlow{*exchange_, spaces_});
    } else {
      run(MpiFlow{*comm_});
    }
    statistics.activePixels = notice.activePixels;
    count(participant.traffic(isRoot), statistics);
    trace_ = {{.kind = TraceStep::Kind::kScan,
               .pixels = static_cast<std::int64_t>(mine.active.pixels())}};
    trace_.insert(trace_.end(), participant.trace().begin(), participant.trace().end());
    // Ends the frame for all: the root's is complete, and memory that others read may be written
    // again.
    endFrame(participant.outcome());
    if (!isRoot) return std::nullopt;
    return ImageView<const Pixel>{mine.frame, frame.pixels()};
  }

  /// How the last frame was composited: for statistics and tests.
  const FramePlan& lastPlan() const { return plan_; }
  bool isPacking() const { return isPacking_; }
  /// What this rank did in the last frame, without the collectives: for cost models.
  const FrameTrace& lastTrace() const { return trace_; }
  const HostMemory& hosts() const { return hosts_; }

 private:
  /// Local. Takes back the last frame's memory; says where pixels that lie in `drawn` stay.
  Keep beginFrame(const CompositeOptions& options, const SharedLayout& layout,
                  std::span<const std::byte> drawn);
  /// Local. Has memory of this layout to share.
  void share(const SharedLayout& layout);
  std::span<std::byte> canvasBytes(const SharedLayout& layout, std::size_t bytes);
  /// The root's frame if this rank can write to it, else nothing.
  std::span<std::byte> frameBytes(const CompositeOptions& options, std::size_t bytes);
  /// Collective. See toRoot() for what it throws.
  const FramePlan& agreeOnPlan(const CompositeOptions& options, const TileGrid& grid,
                               std::span<const Rank> order, FrameNotice& notice, Outcome drawing,
                               std::size_t pixelBytes);
  /// On the root, by tile: whether earlier frames may have left something there.
  std::vector<bool>& leftInFrame(std::span<const std::byte> frame, const TileGrid& grid,
                                 const void* algebra);
  /// Collective. Throws CollectiveError if a rank failed.
  void endFrame(const Outcome& mine);
  /// Collective.
  bool packs(const CompositeOptions& options);
  static void count(const Traffic& traffic, RankStatistics& statistics);
  ParticipantMemory memory() { return {isSharing_ ? sharedMemory_ : ownMemory_, ownMemory_}; }

  const Communicator* comm_;
  HostMemory hosts_;
  std::optional<HostMemory> exchangeMemory_;
  std::optional<HostExchange> exchange_;  ///< if all ranks are on one host
  bool isSharing_ = false;                ///< in this frame
  FrameMemory sharedMemory_;
  FrameMemory ownMemory_;
  std::vector<std::byte> ownCanvas_;  ///< where nothing is shared
  std::vector<std::byte> ownFrame_;   ///< likewise
  SharedSpaces spaces_;               ///< of this frame; empty if nothing is shared
  FramePlan plan_;
  FrameTrace trace_;
  LastFrame lastFrame_;
  std::size_t sharedBytes_ = 0;  ///< of the layout in use
  bool isPacking_ = false;
  std::optional<double> linkBytesPerSecond_;  ///< measured once, if it matters
};

}  // namespace burin::compositor
