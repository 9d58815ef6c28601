#pragma once

#include <algorithm>
#include <vector>

#include "affine.hpp"
#include "burin/compositor/pixel_algebra.hpp"
#include "burin/compositor/sparse_tile.hpp"
#include "random_pixels.hpp"

namespace burin::compositor::test {

/// A rectangle in the frame, empty in one of five cases.
inline PixelRect randomRect(ImageSize frame, Random& random) {
  if (below(random, 5) == 0) return {};
  PixelRect rect{below(random, frame.width), below(random, frame.height), 0, 0};
  rect.x1 = rect.x0 + 1 + below(random, frame.width - rect.x0);
  rect.y1 = rect.y0 + 1 + below(random, frame.height - rect.y0);
  return rect;
}

template <PixelAlgebra A>
Subimage<typename A::Pixel> randomSubimage(ImageSize frame, const PixelRect& active,
                                           Random& random) {
  Subimage<typename A::Pixel> image{frame, active, {}};
  for (std::size_t i = 0; i < active.pixels(); ++i) {
    image.pixels.push_back(randomPixel(A{}, random));
  }
  return image;
}

/// Makes about `share` of the pixels the identity, in runs of random lengths.
template <PixelAlgebra A>
void punchHoles(Subimage<typename A::Pixel>& image, float share, Random& random) {
  for (std::size_t i = 0; i < image.pixels.size();) {
    const auto run = std::min<std::size_t>(1 + static_cast<std::size_t>(below(random, 40)),
                                           image.pixels.size() - i);
    if (unit(random) < share)
      std::fill_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(i), run, A::identity());
    i += run;
  }
}

template <PixelAlgebra A>
std::vector<Subimage<typename A::Pixel>> randomSubimages(ImageSize frame, int count,
                                                         unsigned seed) {
  Random random{seed};
  std::vector<Subimage<typename A::Pixel>> images;
  for (int i = 0; i < count; ++i) {
    images.push_back(randomSubimage<A>(frame, randomRect(frame, random), random));
    if (i % 2 == 1) punchHoles<A>(images.back(), 0.5f, random);
  }
  return images;
}

/// The active pixels of a tile, one after the other.
template <typename Pixel>
std::vector<Pixel> pixelsOf(const SparseTile<Pixel>& tile) {
  std::vector<Pixel> all;
  tile.forEachRun([&](const Run& run, const Pixel* pixels) {
    all.insert(all.end(), pixels, pixels + run.pixels());
  });
  return all;
}

/// Front to back, one after the other, over whole frames: what every schedule must equal.
template <PixelAlgebra A>
Image<typename A::Pixel> combineSerially(ImageSize frame,
                                         const std::vector<Subimage<typename A::Pixel>>& images) {
  Image<typename A::Pixel> out{frame};
  std::ranges::fill(out.pixels(), A::identity());
  for (const auto& image : images) {
    std::size_t i = 0;
    for (int y = image.active.y0; y < image.active.y1; ++y) {
      for (int x = image.active.x0; x < image.active.x1; ++x) {
        out.at(x, y) = A::combine(out.at(x, y), image.pixels[i++]);
      }
    }
  }
  return out;
}

template <typename Pixel>
bool areEqual(const Image<Pixel>& a, const Image<Pixel>& b) {
  return a.size() == b.size() && std::ranges::equal(a.pixels(), b.pixels());
}

inline float largestDifference(const Image<Rgba>& a, const Image<Rgba>& b) {
  float largest = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    largest = std::max(largest, largestDifference(a.pixels()[i], b.pixels()[i]));
  }
  return largest;
}

}  // namespace burin::compositor::test
