#pragma once

#include <functional>
#include <span>
#include <vector>

#include "burin/compositor/frame_plan.hpp"
#include "burin/compositor/host_memory.hpp"

namespace burin::compositor {

/// What every rank tells every other one at the start of a frame, in one small all-gather.
struct FrameNotice {
  ImageSize frame;
  std::int64_t activePixels = 0;
  MemoryNotice memory;
  Coverage coverage;

  FrameNotice() = default;
  template <typename Pixel>
  FrameNotice(ImageSize size, const SparseImage<Pixel>& image, const TileGrid& grid)
      : frame{size}, coverage{coverageOf(image, grid)} {
    for (const auto& tile : image) activePixels += tile.active;
  }
};

/// What all ranks know then.
struct FrameNews {
  std::vector<Contribution> contributions;  ///< by rank
  std::vector<MemoryNotice> memories;       ///< by rank
  std::vector<std::int64_t> total;          ///< see makeFramePlan()
};

/// Bytes of a notice as it travels among `ranks` ranks.
std::int64_t noticeBytes(int ranks);

/// Collective. Every rank's bytes (equal sizes) in rank order.
using AllGather = std::function<std::vector<std::byte>(std::span<const std::byte>)>;

/// Collective. Throws on all ranks alike, before any of them waits for pixels: CollectiveError if a
/// rank failed; Error{kRank} if frame sizes, options or orders differ, if `order` names a rank
/// twice or none of the communicator's, if a rank outside `order` drew something, or if a message
/// would be too large for MPI. `pixelBytes`: of one pixel on the wire. `isWithinHost`: no
/// message goes through MPI.
FrameNews exchangeNotices(const Communicator& comm, const AllGather& allGather,
                          const CompositeOptions& options, std::span<const Rank> order,
                          const FrameNotice& mine, Outcome drawing, std::size_t pixelBytes,
                          bool isWithinHost);

}  // namespace burin::compositor
