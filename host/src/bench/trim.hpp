#pragma once

#include <algorithm>

#include "burin/compositor/pixel_algebra.hpp"
#include "burin/compositor/subimage.hpp"

namespace burin::host::bench {

using compositor::PixelAlgebra;
using compositor::Subimage;

/// Smallest rectangle around the pixels that are not the identity; empty if there are none. Local;
/// reads no more than the blank margin and the rectangle's border.
template <PixelAlgebra A>
PixelRect tightRect(const Subimage<typename A::Pixel>& image) {
  PixelRect rect = image.active;
  const auto isBlank = [&](int x, int y) {
    const auto width = static_cast<std::size_t>(image.active.width());
    return A::isIdentity(image.pixels[static_cast<std::size_t>(y - image.active.y0) * width +
                                      static_cast<std::size_t>(x - image.active.x0)]);
  };
  const auto isBlankRow = [&](int y) {
    for (int x = rect.x0; x < rect.x1; ++x) {
      if (!isBlank(x, y)) return false;
    }
    return true;
  };
  while (!rect.empty() && isBlankRow(rect.y0)) ++rect.y0;
  while (!rect.empty() && isBlankRow(rect.y1 - 1)) --rect.y1;
  if (rect.empty()) return {};
  int left = rect.x1;
  int right = rect.x0;
  for (int y = rect.y0; y < rect.y1; ++y) {
    for (int x = rect.x0; x < left; ++x) {
      if (!isBlank(x, y)) left = x;
    }
    for (int x = rect.x1; x > std::max(left, right); --x) {
      if (!isBlank(x - 1, y)) right = x;
    }
  }
  return {left, rect.y0, right, rect.y1};
}

/// Cuts the active rectangle to tightRect(); pixels move within the vector. Local.
template <PixelAlgebra A>
void trim(Subimage<typename A::Pixel>& image) {
  const PixelRect tight = tightRect<A>(image);
  if (tight == image.active) return;
  const auto offset = [&](int x, int y) {
    return (y - image.active.y0) * std::ptrdiff_t{image.active.width()} + (x - image.active.x0);
  };
  auto out = image.pixels.begin();
  for (int y = tight.y0; y < tight.y1; ++y) {
    const auto row = image.pixels.begin() + offset(tight.x0, y);
    out = std::copy(row, row + tight.width(), out);
  }
  image.pixels.resize(tight.pixels());
  image.active = tight;
}

}  // namespace burin::host::bench
