#include "burin/compositor/active_area.hpp"

#include <algorithm>

namespace burin::compositor {

namespace {

/// Number of the first pixel of row `y` of the frame.
std::size_t rowBegin(const PixelRect& bounds, int y) {
  return static_cast<std::size_t>(y - bounds.y0) * static_cast<std::size_t>(bounds.width());
}

/// How many pixels of `rect` have a number below `number`.
std::size_t rectPixelsBefore(const PixelRect& bounds, const PixelRect& rect, std::size_t number) {
  if (rect.empty()) return 0;
  const auto width = static_cast<std::size_t>(bounds.width());
  const auto clampTo = [](std::size_t value, int lo, int hi) {
    return static_cast<std::size_t>(
        std::clamp(static_cast<std::ptrdiff_t>(value), std::ptrdiff_t{lo}, std::ptrdiff_t{hi}) -
        lo);
  };
  const int firstRow = rect.y0 - bounds.y0;
  const int firstColumn = rect.x0 - bounds.x0;
  const std::size_t row = number / width;
  const std::size_t fullRows = clampTo(row, firstRow, firstRow + rect.height());
  const auto rectWidth = static_cast<std::size_t>(rect.width());
  const bool isInside = row >= static_cast<std::size_t>(firstRow) &&
                        row < static_cast<std::size_t>(firstRow + rect.height());
  const std::size_t inRow =
      isInside ? clampTo(number % width, firstColumn, firstColumn + rect.width()) : 0;
  return fullRows * rectWidth + inRow;
}

}  // namespace

std::size_t ActiveArea::pixels() const {
  return pixelsBefore(region.end);
}

std::size_t ActiveArea::pixelsBefore(std::size_t number) const {
  if (region.empty() || number <= region.begin) return 0;
  return rectPixelsBefore(bounds, rect, std::min(number, region.end)) -
         rectPixelsBefore(bounds, rect, region.begin);
}

RowSpan ActiveArea::row(int y) const {
  if (y < rect.y0 || y >= rect.y1) return {};
  const std::size_t begin = rowBegin(bounds, y);
  const std::size_t end = begin + static_cast<std::size_t>(bounds.width());
  const std::size_t from = std::max(region.begin, begin);
  const std::size_t to = std::min(region.end, end);
  if (to <= from) return {};
  return {std::max(rect.x0, bounds.x0 + static_cast<int>(from - begin)),
          std::min(rect.x1, bounds.x0 + static_cast<int>(to - begin))};
}

ActiveArea ActiveArea::within(const Region& part) const {
  ActiveArea area{bounds, part, rect};
  if (area.pixels() == 0) return {bounds, part, {}};
  while (area.row(area.rect.y0).pixels() == 0) ++area.rect.y0;
  while (area.row(area.rect.y1 - 1).pixels() == 0) --area.rect.y1;
  return area;
}

}  // namespace burin::compositor
