#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace burin::compositor {

/// One thing that a rank did in a frame, with its exact size: what a cost model replays. Plain
/// data: ranks send it as bytes.
struct TraceStep {
  enum class Kind : std::int32_t {
    kScan,     ///< looked at `pixels` pixels for the active ones
    kSend,     ///< made a message for `peer`: `bytes` with its pixels, `wireBytes` when packed
    kReceive,  ///< waited for a message of `peer`, took it apart; put `pixels` into the frame
    kCombine,  ///< read `pixels` active pixels of tiles in which several ranks have some; ends a
               ///< round of receives
    kPaste,    ///< put `pixels` active pixels into the frame
    kFinish,   ///< waited until everything sent had left
  };
  /// What a message is for. Messages of one sender and channel come in the order sent.
  enum class Channel : std::int32_t { kNotice, kSwap, kGather, kAgreement };

  Kind kind = Kind::kScan;
  Channel channel = Channel::kSwap;
  std::int32_t peer = -1;  ///< a rank
  std::int32_t isPacked = 0;
  std::int64_t bytes = 0;
  std::int64_t wireBytes = 0;
  std::int64_t pixels = 0;
  friend bool operator==(const TraceStep&, const TraceStep&) = default;
};

/// What a rank did in a frame, in order.
using FrameTrace = std::vector<TraceStep>;

/// What MPI's non-blocking collectives add to a frame of `ranks` ranks, as Open MPI 4.1 carries
/// them out (libnbc): before it an all-gather of `noticeBytes` from every rank, each sending to
/// each other; after it a reduction of a few bytes along a binomial tree to rank 0, and back.
FrameTrace withCollectives(const FrameTrace& frame, int rank, int ranks, std::int64_t noticeBytes);

}  // namespace burin::compositor
