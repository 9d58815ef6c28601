#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "burin/common/error.hpp"
#include "burin/compositor/frame_memory.hpp"
#include "burin/compositor/pixel_algebra.hpp"
#include "burin/compositor/subimage.hpp"
#include "burin/compositor/tile_grid.hpp"

namespace burin::compositor {

/// Places first … last (both included) of a tile, all active.
struct Run {
  std::uint16_t first = 0, last = 0;
  std::uint32_t pixels() const { return std::uint32_t{last} - first + 1; }
  std::uint32_t end() const { return std::uint32_t{last} + 1; }
  friend bool operator==(const Run&, const Run&) = default;
};

/// The active pixels of a tile in ascending runs; all other pixels of the tile are the identity,
/// and nowhere. A view: runs and pixels lie in some FrameMemory, a message or another rank's shared
/// memory. Pixels lie either packed, one after the other, or in place in
/// an image, `stride` pixels from row to row (then no run goes beyond a row).
template <typename Pixel>
struct SparseTile {
  std::span<const Run> runs;
  const Pixel* pixels = nullptr;  ///< the first active one
  std::uint32_t active = 0;
  std::uint32_t stride = 0;  ///< 0: packed
  std::uint32_t width = 0;   ///< of the tile, if in place

  bool empty() const { return active == 0; }
  /// From `pixels` to the first pixel of `run`; `before`: active pixels before it.
  std::size_t offset(const Run& run, std::size_t before) const {
    if (stride == 0) return before;
    const std::size_t rows = run.first / width - runs.front().first / width;
    return rows * stride + run.first % width - runs.front().first % width;
  }
  /// Pixels from the first active one to the last.
  std::size_t extent() const {
    if (empty()) return 0;
    const std::uint32_t last = runs.back().pixels();
    return offset(runs.back(), active - last) + last;
  }
  /// Calls `use(run, pixels)` for each run.
  template <typename Use>
  void forEachRun(Use&& use) const {
    std::size_t before = 0;
    for (const Run& run : runs) {
      use(run, pixels + offset(run, before));
      before += run.pixels();
    }
  }
};

/// A rank's subimage, a tile for each of the grid.
template <typename Pixel>
using SparseImage = std::vector<SparseTile<Pixel>>;

/// Where tiles are put: pixels where other ranks of the host may read them, runs where they travel
/// from by value.
struct TileMemory {
  FrameMemory& pixels;
  FrameMemory& runs;
};

/// A list of runs being made.
class RunList {
 public:
  /// Neighbours become one.
  void append(std::uint32_t first, std::uint32_t pixels) {
    const auto last = static_cast<std::uint16_t>(first + pixels - 1);
    if (!runs_.empty() && runs_.back().end() == first) {
      runs_.back().last = last;
    } else {
      runs_.push_back({static_cast<std::uint16_t>(first), last});
    }
  }
  /// As it is.
  void appendRow(std::uint32_t first, std::uint32_t pixels) {
    runs_.push_back(
        {static_cast<std::uint16_t>(first), static_cast<std::uint16_t>(first + pixels - 1)});
  }
  void clear() { runs_.clear(); }
  std::span<const Run> runs() const { return runs_; }
  std::span<const Run> copyTo(FrameMemory& memory) const {
    const auto out = memory.allocate<Run>(runs_.size());
    std::ranges::copy(runs_, out.begin());
    return out;
  }

 private:
  std::vector<Run> runs_;
};

/// Throws Error{kRank} unless the active rectangle lies in the frame and has its pixels.
template <typename Pixel>
void checkSubimage(const SubimageView<Pixel>& image) {
  const PixelRect& r = image.active;
  if (!r.empty() &&
      (r.x0 < 0 || r.y0 < 0 || r.x1 > image.frame.width || r.y1 > image.frame.height)) {
    fail(ExitCode::kRank, "subimage: active rectangle [{},{})x[{},{}) is not inside {}x{}", r.x0,
         r.x1, r.y0, r.y1, image.frame.width, image.frame.height);
  }
  if (image.pixels.size() != r.pixels()) {
    fail(ExitCode::kRank, "subimage: {} pixels expected, {} given", r.pixels(),
         image.pixels.size());
  }
}

/// Calls `found(place, pixels, count)` for each run of active pixels (those that are not the
/// identity) of each row of `image` inside `rect`, a tile's; places count in `rect`.
template <PixelAlgebra A, typename Found>
void findRuns(const SubimageView<typename A::Pixel>& image, const PixelRect& rect, Found&& found) {
  const PixelRect part = intersection(rect, image.active);
  const auto stride = static_cast<std::ptrdiff_t>(image.active.width());
  const auto width = static_cast<std::uint32_t>(part.width());
  for (int y = part.y0; y < part.y1; ++y) {
    const auto* const row =
        image.pixels.data() + (y - image.active.y0) * stride + (part.x0 - image.active.x0);
    const auto place = static_cast<std::uint32_t>((y - rect.y0) * rect.width() + part.x0 - rect.x0);
    for (std::uint32_t x = 0;;) {
      while (x < width && A::isIdentity(row[x])) ++x;
      if (x == width) break;
      const std::uint32_t first = x;
      while (x < width && !A::isIdentity(row[x])) ++x;
      found(place + first, row + first, x - first);
    }
  }
}

/// Where a subimage's pixels stay while its frame is composited.
enum class Keep {
  kCopy,     ///< active ones are copied
  kInPlace,  ///< where they are: others of the host can read them there, or need not
};

/// The active pixels of `image` inside `rect`, a tile's.
template <PixelAlgebra A>
SparseTile<typename A::Pixel> compressTile(const SubimageView<typename A::Pixel>& image,
                                           const PixelRect& rect, Keep keep, TileMemory memory,
                                           RunList& list) {
  using Pixel = typename A::Pixel;
  list.clear();
  SparseTile<Pixel> tile;
  if (keep == Keep::kInPlace) {
    findRuns<A>(image, rect, [&](std::uint32_t place, const Pixel* pixels, std::uint32_t count) {
      if (tile.empty()) tile.pixels = pixels;
      list.appendRow(place, count);
      tile.active += count;
    });
    tile.stride = static_cast<std::uint32_t>(image.active.width());
    tile.width = static_cast<std::uint32_t>(rect.width());
  } else {
    const auto room = memory.pixels.allocate<Pixel>(intersection(rect, image.active).pixels());
    findRuns<A>(image, rect, [&](std::uint32_t place, const Pixel* pixels, std::uint32_t count) {
      list.append(place, count);
      std::copy_n(pixels, count, room.data() + tile.active);
      tile.active += count;
    });
    tile.pixels = memory.pixels.keepFirst(room, tile.active).data();
  }
  tile.runs = list.copyTo(memory.runs);
  return tile;
}

/// Local. Only tiles that meet the active rectangle are looked at. `image` has passed
/// checkSubimage().
template <PixelAlgebra A>
SparseImage<typename A::Pixel> compress(const SubimageView<typename A::Pixel>& image,
                                        const TileGrid& grid, Keep keep, TileMemory memory) {
  SparseImage<typename A::Pixel> tiles(grid.count());
  if (image.active.empty()) return tiles;
  RunList list;
  const int lastColumn = (image.active.x1 - 1) / grid.tileWidth();
  const int lastRow = (image.active.y1 - 1) / grid.tileHeight();
  for (int row = image.active.y0 / grid.tileHeight(); row <= lastRow; ++row) {
    for (int column = image.active.x0 / grid.tileWidth(); column <= lastColumn; ++column) {
      const auto tile = static_cast<std::size_t>(row * grid.columns() + column);
      tiles[tile] = compressTile<A>(image, grid.rect(tile), keep, memory, list);
    }
  }
  return tiles;
}

/// Writes a tile to its place in a frame, every pixel of its rectangle once: what is not active
/// becomes the identity.
template <PixelAlgebra A>
void pasteTile(const SparseTile<typename A::Pixel>& tile, const PixelRect& rect,
               ImageView<typename A::Pixel> frame) {
  const auto width = static_cast<std::uint32_t>(rect.width());
  const auto end = static_cast<std::uint32_t>(rect.pixels());
  /// Calls `write(destination, pixels)` for each part in one row of places [from, to).
  const auto forEachRow = [&](std::uint32_t from, std::uint32_t to, auto&& write) {
    while (from < to) {
      const std::uint32_t count = std::min(to - from, width - from % width);
      write(&frame.at(rect.x0 + static_cast<int>(from % width),
                      rect.y0 + static_cast<int>(from / width)),
            count);
      from += count;
    }
  };
  const auto clear = [](auto* out, std::uint32_t n) { std::fill_n(out, n, A::identity()); };
  std::uint32_t place = 0;
  tile.forEachRun([&](const Run& run, const auto* pixels) {
    forEachRow(place, run.first, clear);
    forEachRow(run.first, run.end(), [&](auto* out, std::uint32_t n) {
      std::copy_n(pixels, n, out);
      pixels += n;
    });
    place = run.end();
  });
  forEachRow(place, end, clear);
}

}  // namespace burin::compositor
