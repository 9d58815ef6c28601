#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <type_traits>

#include "covering_rows.hpp"

/// What is drawn in a frame of the covering array, and what must come of it.
namespace burin::compositor::test {

/// About `share` of the pixels of `rect` in runs of random lengths; some may be the identity.
template <PixelAlgebra A>
Subimage<typename A::Pixel> scattered(ImageSize frame, const PixelRect& rect, float share,
                                      Random& random) {
  // Drawing millions of random numbers would take longer than compositing them.
  std::vector<typename A::Pixel> palette;
  for (int i = 0; i < 997; ++i) palette.push_back(randomPixel(A{}, random));
  Subimage<typename A::Pixel> image{frame, rect, {}};
  image.pixels.resize(rect.pixels(), A::identity());
  for (std::size_t begin = 0; begin < image.pixels.size();) {
    const std::size_t end =
        std::min(begin + 1 + static_cast<std::size_t>(below(random, 40)), image.pixels.size());
    const auto colour = static_cast<std::size_t>(below(random, 900));
    const bool isActive = unit(random) < share;
    for (std::size_t i = begin; isActive && i < end; ++i) {
      image.pixels[i] = palette[colour + i - begin];
    }
    begin = end;
  }
  return image;
}

/// Somewhere in the frame; at least one pixel.
inline PixelRect rectOf(ImageSize frame, int width, int height, Random& random) {
  width = std::max(width, 1);
  height = std::max(height, 1);
  const int x = below(random, frame.width - width + 1);
  const int y = below(random, frame.height - height + 1);
  return {x, y, x + width, y + height};
}

/// What a rank draws. Half of the ranks fill a small rectangle, the others have holes in a large
/// one.
template <PixelAlgebra A>
Subimage<typename A::Pixel> drawnBy(const FrameRow& row, int rank) {
  const ImageSize size = row.size;
  Random random{row.seed * 64 + static_cast<unsigned>(rank)};
  const PixelRect whole{0, 0, size.width, size.height};
  const bool isDense = rank % 2 == 0;
  switch (row.drawn) {
    case Drawn::kNothing: {
      if (isDense) return {size, {}, {}};
      return scattered<A>(size, rectOf(size, size.width / 7, size.height / 7, random), 0, random);
    }
    case Drawn::kOnePixel: {  // mostly the same
      Random common{row.seed};
      return scattered<A>(size, rectOf(size, 1, 1, rank % 4 == 3 ? random : common), 1, random);
    }
    case Drawn::kHundredth:
      if (!isDense) return scattered<A>(size, whole, 0.01f, random);
      return scattered<A>(size, rectOf(size, size.width / 10, size.height / 10, random), 1, random);
    case Drawn::kHalf:
      if (!isDense) return scattered<A>(size, whole, 0.5f, random);
      return scattered<A>(size, rectOf(size, size.width, size.height / 2, random), 1, random);
    case Drawn::kAll:
      break;
  }
  return scattered<A>(size, whole, 1, random);
}

struct ExactRgba {
  double r = 0, g = 0, b = 0, a = 0;
};

inline ExactRgba exactOver(const ExactRgba& front, const Rgba& back) {
  const double t = 1.0 - front.a;
  return {front.r + t * double{back.r}, front.g + t * double{back.g}, front.b + t * double{back.b},
          front.a + t * double{back.a}};
}

/// Combines all that is drawn, whole frames one behind the other. `combine(sum, pixel)`.
template <PixelAlgebra A, typename Sum, typename Combine>
Image<Sum> combinedDrawings(const FrameRow& row, const Sum& nothing, Combine&& combine) {
  Image<Sum> sum{row.size};
  std::ranges::fill(sum.pixels(), nothing);
  for (const Rank rank : row.order()) {
    const auto image = drawnBy<A>(row, static_cast<int>(rank));
    std::size_t i = 0;
    for (int y = image.active.y0; y < image.active.y1; ++y) {
      for (int x = image.active.x0; x < image.active.x1; ++x) {
        sum.at(x, y) = combine(sum.at(x, y), image.pixels[i++]);
      }
    }
  }
  return sum;
}

/// How far colour and opacity may be from the exact picture.
struct Bound {
  double colour = 0, opacity = 0;
};

/// What was asked of float; it is not a bound for any input: 24 ranks may round 72 times, but
/// what lies far behind weighs little.
inline Bound exactBound(const Over&, int /*ranks*/) {
  return {1e-6, 1e-6};
}

/// over_half.hpp's: a pixel crosses in each round, once when the count is reduced to one that
/// halves, and to the root. Higher orders add less than 1 %; then float's own rounding.
inline Bound exactBound(const OverHalf&, int ranks) {
  const int crossings = static_cast<int>(std::bit_width(static_cast<unsigned>(ranks))) + 1;
  const double rest = crossings * ranks * 0x1p-25 + double{overTolerance(ranks)};
  return {1.01 * crossings * 0x1p-10 + rest, 1.01 * crossings * 0x1p-11 + rest};
}

inline bool isWithin(const Bound& bound, const Rgba& p, const ExactRgba& exact) {
  return std::abs(double{p.a} - exact.a) <= bound.opacity &&
         std::abs(double{p.r} - exact.r) <= bound.colour &&
         std::abs(double{p.g} - exact.g) <= bound.colour &&
         std::abs(double{p.b} - exact.b) <= bound.colour;
}

/// Whether all pixels of a finished frame agree with those expected.
template <typename Pixel, typename Sum, typename Agree>
testing::AssertionResult areAll(ImageView<const Pixel> frame, const Image<Sum>& expected,
                                Agree&& agree) {
  if (frame.size() != expected.size()) return testing::AssertionFailure() << "of another size";
  for (std::size_t i = 0; i < frame.pixels().size(); ++i) {
    if (!agree(frame.pixels()[i], expected.pixels()[i])) {
      return testing::AssertionFailure() << "pixel " << i << " is wrong";
    }
  }
  return testing::AssertionSuccess();
}

/// `frame` is the serial combination of what was drawn, as exactly as the algebra promises.
template <PixelAlgebra A>
testing::AssertionResult isSerialCombination(const FrameRow& row,
                                             ImageView<const typename A::Pixel> frame) {
  if constexpr (std::is_same_v<A, Over> || std::is_same_v<A, OverHalf>) {
    const auto exact = combinedDrawings<A>(row, ExactRgba{}, exactOver);
    const Bound bound = exactBound(A{}, row.ranks);
    const auto isExact = areAll(
        frame, exact, [&](const Rgba& p, const ExactRgba& q) { return isWithin(bound, p, q); });
    if (!isExact || std::is_same_v<A, OverHalf>) return isExact;
  }
  return areAll(frame, combinedDrawings<A>(row, A::identity(), A::combine),
                [&](const auto& p, const auto& q) { return agree(A{}, p, q, row.ranks); });
}

}  // namespace burin::compositor::test
