#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "burin/compositor/sparse_tile.hpp"

namespace burin::compositor {

/// Combines tiles of the same place, all in one pass: every pixel is read once and written once,
/// and the reads of the tiles overlap.
template <PixelAlgebra A>
class TileCombiner {
 public:
  using Pixel = typename A::Pixel;
  using Tile = SparseTile<Pixel>;

  /// Left fold of `tiles`, front to back: ((t0 · t1) · t2) …; the grouping never depends on what
  /// the tiles hold or when they came. If only one has anything, the result refers to it and
  /// nothing is copied. `tilePixels`: of the tile's rectangle.
  Tile fold(std::span<const Tile> tiles, std::size_t tilePixels, TileMemory memory) {
    cursors_.clear();
    std::size_t bound = 0;
    const Tile* last = nullptr;
    for (const Tile& tile : tiles) {
      if (tile.empty()) continue;
      last = &tile;
      bound += tile.active;
      cursors_.emplace_back(tile);
    }
    if (cursors_.size() < 2) return last == nullptr ? Tile{} : *last;

    const auto room = memory.pixels.allocate<Pixel>(std::min(bound, tilePixels));
    runs_.clear();
    Pixel* out = room.data();
    for (;;) {
      const std::uint32_t place = firstPlace();
      if (place == kEnd) break;
      const std::uint32_t count = segmentEnd(place) - place;
      pixels_.clear();
      for (Cursor& cursor : cursors_) {
        if (cursor.place() == place) pixels_.push_back(cursor.take(count));
      }
      combine(pixels_, out, count);
      runs_.append(place, count);
      out += count;
    }
    const auto active = static_cast<std::uint32_t>(out - room.data());
    memory.pixels.keepFirst(room, active);
    return {runs_.copyTo(memory.runs), room.data(), active, 0, 0};
  }

 private:
  static constexpr std::uint32_t kEnd = ~std::uint32_t{0};

  /// Walks over the active places of a tile.
  class Cursor {
   public:
    explicit Cursor(const Tile& tile) : tile_{&tile}, runs_{tile.runs} { enter(); }
    std::uint32_t place() const { return place_; }  ///< kEnd at the end
    std::uint32_t end() const { return runs_.front().end(); }
    const Pixel* take(std::uint32_t count) {
      const Pixel* const taken = pixels_;
      pixels_ += count;
      place_ += count;
      if (place_ == runs_.front().end()) {
        before_ += runs_.front().pixels();
        runs_ = runs_.subspan(1);
        enter();
      }
      return taken;
    }

   private:
    void enter() {
      place_ = kEnd;
      if (runs_.empty()) return;
      place_ = runs_.front().first;
      pixels_ = tile_->pixels + tile_->offset(runs_.front(), before_);
    }
    const Tile* tile_;
    std::span<const Run> runs_;
    const Pixel* pixels_ = nullptr;
    std::size_t before_ = 0;  ///< active pixels before the run
    std::uint32_t place_ = 0;
  };

  std::uint32_t firstPlace() const {
    std::uint32_t place = kEnd;
    for (const Cursor& cursor : cursors_) place = std::min(place, cursor.place());
    return place;
  }

  /// Up to where the same tiles as at `place` are active.
  std::uint32_t segmentEnd(std::uint32_t place) const {
    std::uint32_t end = kEnd;
    for (const Cursor& cursor : cursors_) {
      end = std::min(end, cursor.place() == place ? cursor.end() : cursor.place());
    }
    return end;
  }

  /// The inner loop of all compositing. `out` is none of the inputs.
  static void combine(std::span<const Pixel* const> inputs, Pixel* __restrict out,
                      std::uint32_t count) {
    const Pixel* const first = inputs.front();
    if (inputs.size() == 1) {
      std::copy_n(first, count, out);
      return;
    }
    const Pixel* const second = inputs[1];
    if (inputs.size() == 2) {
      for (std::uint32_t i = 0; i < count; ++i) out[i] = A::combine(first[i], second[i]);
      return;
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      Pixel pixel = A::combine(first[i], second[i]);
      for (const Pixel* const input : inputs.subspan(2)) pixel = A::combine(pixel, input[i]);
      out[i] = pixel;
    }
  }

  std::vector<Cursor> cursors_;
  std::vector<const Pixel*> pixels_;  ///< where the tiles that are active at a place are
  RunList runs_;
};

}  // namespace burin::compositor
