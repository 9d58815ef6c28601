#pragma once

#include <thread>
#include <utility>
#include <vector>

#include "burin/compositor/executor.hpp"
#include "burin/compositor/in_process_flow.hpp"

namespace burin::compositor {

/// What became of a frame composited in this process.
template <typename Pixel>
struct InProcessFrame {
  FramePlan plan;
  Image<Pixel> frame;
  std::vector<Traffic> traffic;    ///< by rank
  std::vector<Outcome> outcomes;   ///< by rank
  std::vector<FrameTrace> traces;  ///< by rank; of messages and combining alone
};

/// Composites a frame in this process, a thread for each rank, with the messages that ranks would
/// exchange: the same bytes and, bit for bit, the same pixels as Compositor. For tests (thread
/// sanitizer) and for counting what a frame would cost. `images`: one subimage per rank; `order`:
/// ranks front to back. With options.isSharingMemory the ranks are on one host, else each has its
/// own.
template <PixelAlgebra A>
InProcessFrame<typename A::Pixel> compositeInProcess(
    const CompositeOptions& options, ImageSize size, std::span<const Rank> order,
    const std::vector<Subimage<typename A::Pixel>>& images) {
  using Pixel = typename A::Pixel;
  /// What is a rank's own.
  struct Place {
    std::vector<std::byte> bytes;
    FrameMemory shared;
    FrameMemory own;
    SparseImage<Pixel> image;
  };
  const std::size_t ranks = images.size();
  const TileGrid grid{size};
  std::vector<Place> places(ranks);
  std::vector<Contribution> contributions(ranks);
  std::vector<std::int64_t> total(Coverage::kCells, 0);
  std::vector<std::span<const std::byte>> memories(options.isSharingMemory ? ranks : 0);
  for (std::size_t i = 0; i < ranks; ++i) {
    Place& place = places[i];
    if (options.isSharingMemory) {
      place.bytes.resize(4 * size.pixels() * (sizeof(Pixel) + 4) + 65536);
      place.shared = FrameMemory{place.bytes};
      memories[i] = place.bytes;
    }
    checkSubimage<Pixel>(images[i]);
    place.image =
        compress<A>(images[i], grid, options.isSharingMemory ? Keep::kCopy : Keep::kInPlace,
                    {place.shared, place.own});
    contributions[i].coverage = coverageOf(place.image, grid);
    for (const auto& tile : place.image) contributions[i].activePixels += tile.active;
    for (std::size_t cell = 0; cell < total.size(); ++cell) {
      total[cell] += contributions[i].coverage[cell];
    }
  }
  const SharedSpaces spaces{std::move(memories)};
  const LinkClass link =
      options.link.value_or(options.isSharingMemory ? LinkClass::kSharedMemory : LinkClass::kFast);
  InProcessFrame<Pixel> result;
  result.plan = makeFramePlan(options, link, grid, order, contributions, total, A::kMaxWireBytes);
  result.frame = Image<Pixel>{size};
  std::vector<bool> isWritten(grid.count(), true);
  clearUnusedTiles<A>(result.plan, result.frame, isWritten);

  Mailboxes mailboxes;
  std::vector<Participant<A>> participants;
  const auto frameOf = [&](std::size_t rank) -> ImageView<Pixel> {
    const bool canWrite = options.isSharingMemory || Rank{static_cast<int>(rank)} == options.root;
    return canWrite ? ImageView<Pixel>{result.frame} : ImageView<Pixel>{size, {}};
  };
  for (std::size_t i = 0; i < ranks; ++i) {
    participants.emplace_back(result.plan, spaces, places[i].image, frameOf(i),
                              ParticipantMemory{places[i].shared, places[i].own});
  }
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 0; i < ranks; ++i) {
      threads.emplace_back([&, i] {
        const Rank rank{static_cast<int>(i)};
        InProcessFlow flow{mailboxes, rank};
        runFrame(flow, options, rank, declaredPacking(options).value_or(false), spaces,
                 participants[i], frameOf(i), [] {});
      });
    }
  }
  for (std::size_t i = 0; i < ranks; ++i) {
    result.traffic.push_back(participants[i].traffic(Rank{static_cast<int>(i)} == options.root));
    result.outcomes.push_back(participants[i].outcome());
    result.traces.push_back(participants[i].trace());
  }
  return result;
}

}  // namespace burin::compositor
