#pragma once

#include <cstddef>

#include "burin/common/image.hpp"
#include "burin/compositor/region.hpp"

namespace burin::compositor {

/// Columns [x0, x1) of one row.
struct RowSpan {
  int x0 = 0, x1 = 0;
  std::size_t pixels() const { return x1 <= x0 ? 0 : static_cast<std::size_t>(x1 - x0); }
};

/// The pixels of rectangle `rect` (inside `bounds`) whose numbers lie in `region`. Stored row by
/// row they are in the order of their numbers, so the pixels of a smaller region are a consecutive
/// part.
struct ActiveArea {
  PixelRect bounds;
  Region region;
  PixelRect rect;

  std::size_t pixels() const;
  /// How many of its pixels have a number below `number`.
  std::size_t pixelsBefore(std::size_t number) const;
  /// Its columns in row `y` (of the frame); empty outside `rect`.
  RowSpan row(int y) const;
  /// The part of it in `part` (inside `region`), `rect` cut to the rows that hold pixels of it; an
  /// empty rectangle if there are none.
  ActiveArea within(const Region& part) const;
};

/// Calls `visit(y, span, first)` for each row with pixels, top to bottom; `first` is the place of
/// the row's first pixel in row-by-row storage.
template <typename Visit>
void forEachRow(const ActiveArea& area, Visit&& visit) {
  std::size_t first = 0;
  for (int y = area.rect.y0; y < area.rect.y1; ++y) {
    const RowSpan span = area.row(y);
    if (span.pixels() == 0) continue;
    visit(y, span, first);
    first += span.pixels();
  }
}

}  // namespace burin::compositor
