#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "burin/compositor/combine_tiles.hpp"
#include "burin/compositor/frame_plan.hpp"
#include "burin/compositor/frame_trace.hpp"
#include "burin/compositor/received.hpp"
#include "burin/compositor/tile_message.hpp"

namespace burin::compositor {

/// What one rank sent and received: whole messages, and pixels handed over by reference.
struct Traffic {
  std::int64_t bytesSent = 0;      ///< messages, and pixels handed over without one
  std::int64_t bytesReceived = 0;  ///< messages, and pixels they refer to
  std::int64_t messagesSent = 0;
  std::int64_t bytesToRoot = 0;  ///< of bytesSent, finished pixels for the gather
  /// Of bytesSent, those that others of the host read, or that were put into the root's frame, in
  /// shared memory.
  std::int64_t bytesByReference = 0;
  std::int64_t bytesPackedAway = 0;  ///< what zstd saved; not in bytesSent
};

/// Memory that a participant uses in one frame and keeps for the next.
struct ParticipantMemory {
  FrameMemory& shared;  ///< pixels and messages that other ranks of the host may read
  FrameMemory& own;     ///< runs, messages to other hosts and from them
  TileMemory tiles() { return {shared, own}; }
};

/// Where a message goes, what for, and whether zstd packs it if it leaves the host.
struct Way {
  Rank receiver{0};
  Tag tag = Tag::kSwap;
  bool isPacked = false;
};

/// One contributor's pixels while a frame is composited, whoever carries the messages. Others wait
/// for the messages, so failures are noted and it goes on with no pixels; the outcome tells. Only
/// room() throws.
template <PixelAlgebra A>
class Participant {
 public:
  using Pixel = typename A::Pixel;
  using Tile = SparseTile<Pixel>;

  /// `image`: its tiles by number. `spaces`: memories of this host, empty if nothing is shared.
  /// `frame`: the root's, if this participant can write to it, else without pixels. Everything
  /// referred to must outlive the participant.
  Participant(const FramePlan& plan, const SharedSpaces& spaces, const SparseImage<Pixel>& image,
              ImageView<Pixel> frame, ParticipantMemory memory)
      : plan_{&plan},
        spaces_{&spaces},
        frame_{frame},
        memory_{memory},
        tiles_(plan.assignment.tiles.size()) {
    if (image.empty()) return;
    for (std::size_t position = 0; position < tiles_.size(); ++position) {
      tiles_[position] = image[plan.assignment.tiles[position]];
    }
  }

  /// The message with the tiles of `region`, which are no longer held after.
  std::span<const std::byte> give(const Region& region, const Way& way) {
    const bool isShared = spaces_->reaches(static_cast<int>(way.receiver));
    const std::span<Tile> given = tilesOf(region);
    EncodedMessage message;
    note(attempt([&] {
      message = encodeTiles<A>(std::span<const Tile>{given}, region,
                               {isShared ? spaces_ : nullptr, way.isPacked && !isShared},
                               isShared ? memory_.shared : memory_.own);
    }));
    if (outcome_.failed) message = {emptyMessage(region, isShared), 0, 0};
    std::ranges::fill(given, Tile{});
    const auto bytes = static_cast<std::int64_t>(message.bytes.size() + message.referred);
    traffic_.bytesSent += bytes;
    if (way.tag == Tag::kGather) traffic_.bytesToRoot += bytes;
    traffic_.bytesByReference += static_cast<std::int64_t>(message.referred);
    traffic_.bytesPackedAway += static_cast<std::int64_t>(message.packedAway);
    ++traffic_.messagesSent;
    trace_.push_back({.kind = TraceStep::Kind::kSend,
                      .channel = channelOf(way.tag),
                      .peer = static_cast<int>(way.receiver),
                      .isPacked = message.packedAway > 0 ? 1 : 0,
                      .bytes = static_cast<std::int64_t>(message.bytes.size() + message.packedAway),
                      .wireBytes = static_cast<std::int64_t>(message.bytes.size())});
    return message.bytes;
  }

  /// Room for a message that comes. Throws std::bad_alloc, alone here: others then wait in vain.
  std::span<std::byte> room(std::size_t bytes) { return memory_.own.allocate<std::byte>(bytes); }

  /// Combines the messages of a round, all for `region`, with what is held of it. `self`: this
  /// participant's number, its place in visibility order among the senders.
  /// If the result `isFinal` and this participant can write to the root's frame, it is put there
  /// at once and not held.
  void combine(const Region& region, int self, std::span<const Received> messages, bool isFinal) {
    std::vector<Source> sources;
    for (const Received& message : messages) {
      sources.push_back({message.peer, decode(message, region, Tag::kSwap)});
    }
    std::ranges::sort(sources, {}, &Source::participant);
    note(attempt([&] { fold(region, self, sources, isFinal && canDeposit()); }));
  }

  bool canDeposit() const { return !frame_.pixels().empty(); }
  /// Puts what is held of `region` into the root's frame.
  void deposit(const Region& region) {
    const std::int64_t before = deposited_;
    for (std::size_t p = region.begin; p < region.end; ++p) depositTile(p, tiles_[p]);
    trace_.push_back({.kind = TraceStep::Kind::kPaste, .pixels = deposited_ - before});
  }

  /// The tiles that `message` brings for `region`; none if it is damaged, which is noted.
  std::vector<PlacedTile<Pixel>> decode(const Received& message, const Region& region, Tag tag) {
    DecodedMessage<Pixel> decoded;
    Outcome outcome = attempt([&] {
      decoded = decodeTiles<A>(
          message.bytes, region, [&](std::size_t position) { return plan_->rectAt(position); },
          *spaces_, memory_.own);
    });
    traffic_.bytesReceived += static_cast<std::int64_t>(message.bytes.size() + decoded.referred);
    outcome.reason =
        fmt::format("message from rank {}: {}", static_cast<int>(message.sender), outcome.reason);
    note(std::move(outcome));
    std::int64_t active = 0;
    for (const auto& placed : decoded.tiles) active += placed.tile.active;
    trace_.push_back({.kind = TraceStep::Kind::kReceive,
                      .channel = channelOf(tag),
                      .peer = static_cast<int>(message.sender),
                      .pixels = tag == Tag::kGather ? active : 0});
    return std::move(decoded.tiles);
  }

  const FramePlan& plan() const { return *plan_; }
  /// `isRoot`: what it put into its own frame was not sent.
  Traffic traffic(bool isRoot) const {
    Traffic traffic = traffic_;
    const auto bytes = isRoot ? 0 : deposited_ * static_cast<std::int64_t>(sizeof(Pixel));
    traffic.bytesSent += bytes;
    traffic.bytesToRoot += bytes;
    traffic.bytesByReference += bytes;
    return traffic;
  }
  const Outcome& outcome() const { return outcome_; }  ///< the first failure, if any
  const FrameTrace& trace() const { return trace_; }   ///< without collectives

 private:
  struct Source {
    int participant = 0;
    std::vector<PlacedTile<Pixel>> tiles;
    std::size_t next = 0;

    /// Its tile at `position`; to be asked in ascending order.
    Tile take(std::size_t position) {
      if (next == tiles.size() || tiles[next].position != position) return {};
      return tiles[next++].tile;
    }
  };

  static TraceStep::Channel channelOf(Tag tag) {
    return tag == Tag::kGather ? TraceStep::Channel::kGather : TraceStep::Channel::kSwap;
  }

  std::span<Tile> tilesOf(const Region& region) {
    return std::span{tiles_}.subspan(region.begin, region.length());
  }

  void fold(const Region& region, int self, std::span<Source> sources, bool isDeposited) {
    std::vector<Tile> stack;
    std::int64_t combined = 0;
    const std::int64_t before = deposited_;
    // What is put into the frame at once needs room for one tile only, which stays in the cache.
    const TileMemory memory =
        isDeposited ? TileMemory{scratch_, scratch_} : TileMemory{memory_.shared, memory_.own};
    for (std::size_t position = region.begin; position < region.end; ++position) {
      stack.clear();
      bool isPlaced = false;  // what is held here
      for (Source& source : sources) {
        if (!isPlaced && source.participant > self) {
          stack.push_back(tiles_[position]);
          isPlaced = true;
        }
        stack.push_back(source.take(position));
      }
      if (!isPlaced) stack.push_back(tiles_[position]);
      combined += combinedPixels(stack);
      const Tile tile = combiner_.fold(stack, plan_->rectAt(position).pixels(), memory);
      if (isDeposited) {
        depositTile(position, tile);
        scratch_.reset();
      } else {
        tiles_[position] = tile;
      }
    }
    trace_.push_back({.kind = TraceStep::Kind::kCombine, .pixels = combined});
    if (isDeposited) {
      trace_.push_back({.kind = TraceStep::Kind::kPaste, .pixels = deposited_ - before});
    }
  }

  /// What is read of tiles that are combined; one alone is only referred to.
  static std::int64_t combinedPixels(std::span<const Tile> stack) {
    const auto withPixels = std::ranges::count_if(stack, [](const Tile& t) { return !t.empty(); });
    std::int64_t pixels = 0;
    if (withPixels > 1) {
      for (const Tile& tile : stack) pixels += tile.active;
    }
    return pixels;
  }

  void depositTile(std::size_t position, const Tile& tile) {
    pasteTile<A>(tile, plan_->rectAt(position), frame_);
    deposited_ += tile.active;
  }

  void note(Outcome outcome) {
    if (outcome.failed && !outcome_.failed) outcome_ = std::move(outcome);
  }

  std::span<const std::byte> emptyMessage(const Region& region, bool isShared) {
    const auto message = emptyTileMessage(region, A::kMaxWireBytes);
    const auto room = (isShared ? memory_.shared : memory_.own).allocate<std::byte>(message.size());
    std::ranges::copy(message, room.begin());
    return room;
  }

  const FramePlan* plan_;
  const SharedSpaces* spaces_;
  ImageView<Pixel> frame_;
  ParticipantMemory memory_;
  FrameMemory scratch_;
  std::int64_t deposited_ = 0;  ///< active pixels
  std::vector<Tile> tiles_;     ///< by position
  TileCombiner<A> combiner_;
  Traffic traffic_;
  FrameTrace trace_;
  Outcome outcome_;
};

}  // namespace burin::compositor
