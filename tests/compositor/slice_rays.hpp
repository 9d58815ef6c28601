#pragma once

#include <vector>

#include "random_pixels.hpp"

namespace burin::compositor::test {

/// All strings of `length` symbols, one after the other.
template <typename Use>
void forEachRay(int length, Use&& use) {
  std::vector<SliceSymbol> ray(static_cast<std::size_t>(length));
  int rays = 1;
  for (int i = 0; i < length; ++i) rays *= int{kSliceSymbols};
  for (int number = 0; number < rays; ++number) {
    int digits = number;
    for (SliceSymbol& symbol : ray) {
      symbol = static_cast<SliceSymbol>(digits % int{kSliceSymbols});
      digits /= int{kSliceSymbols};
    }
    use(ray);
  }
}

struct Walk {
  RayState state = RayState::kEmpty;
  float depth = -1;  ///< of the last contour slice before the silhouette
};

/// The state machine in words, without the table: a filled slice before any silhouette ends the ray
/// as filled; empty space after a contour ends it as silhouette. Slice i has depth firstDepth + i.
inline Walk walk(Walk at, const std::vector<SliceSymbol>& slices, float firstDepth) {
  float depth = firstDepth;
  for (const SliceSymbol symbol : slices) {
    const bool isDone = at.state == RayState::kFilled || at.state == RayState::kSilhouette;
    if (!isDone && symbol == SliceSymbol::kFilled) at.state = RayState::kFilled;
    if (!isDone && symbol == SliceSymbol::kContour) at = {RayState::kContour, depth};
    if (!isDone && symbol == SliceSymbol::kEmpty && at.state == RayState::kContour) {
      at.state = RayState::kSilhouette;
    }
    depth += 1;
  }
  return at;
}

/// Combines neighbours in random order until one is left, as ranks would.
template <PixelAlgebra A>
typename A::Pixel combineAtRandom(std::vector<typename A::Pixel> pixels, Random& random) {
  if (pixels.empty()) return A::identity();
  while (pixels.size() > 1) {
    const auto i = static_cast<std::ptrdiff_t>(random() % (pixels.size() - 1));
    const auto front = pixels.begin() + i;
    *front = A::combine(*front, *(front + 1));
    pixels.erase(front + 1);
  }
  return pixels.front();
}

}  // namespace burin::compositor::test
