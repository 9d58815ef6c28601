#include "burin/common/image.hpp"

#include <algorithm>

namespace burin {

std::size_t PixelRect::pixels() const {
  return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
}

PixelRect intersection(const PixelRect& a, const PixelRect& b) {
  const PixelRect both{std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1),
                       std::min(a.y1, b.y1)};
  return both.empty() ? PixelRect{} : both;
}

PixelRect boundingRect(const PixelRect& a, const PixelRect& b) {
  if (a.empty()) return b.empty() ? PixelRect{} : b;
  if (b.empty()) return a;
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

}  // namespace burin
