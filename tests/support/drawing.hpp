#pragma once

#include <algorithm>
#include <cmath>

#include "burin/common/image.hpp"
#include "burin/common/scene.hpp"
#include "burin/node/brick_source.hpp"
#include "burin/node/reference.hpp"
#include "burin/node/worker.hpp"

namespace burin::test {

/// The scene with what depends on the volume filled in.
inline Scene resolved(Scene scene, const node::BrickSource& source) {
  resolveScene(scene, {source.info().grid, source.info().anatomical});
  return scene;
}

/// A subimage as a whole frame.
inline Image<Rgba> wholeFrame(const compositor::Subimage<Rgba>& subimage) {
  Image<Rgba> image{subimage.frame};
  const PixelRect& active = subimage.active;
  const auto width = static_cast<std::size_t>(active.width());
  for (int y = active.y0; y < active.y1; ++y)
    std::copy_n(subimage.pixels.begin() +
                    static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y - active.y0) * width),
                width, image.row(y).begin() + active.x0);
  return image;
}

/// Draws on this process alone.
inline Image<Rgba> drawAlone(const Scene& scene, node::BrickSource& source, const Camera& camera,
                             const node::WorkerOptions& options = {},
                             RankStatistics* statistics = nullptr) {
  const Communicator self{MPI_COMM_SELF};
  node::Worker worker{self, scene, source, options};
  RankStatistics local;
  return wholeFrame(worker.draw(camera, statistics != nullptr ? *statistics : local));
}

struct Difference {
  double largest = 0;  ///< over all channels and pixels
  double rms = 0;
  bool finite = true;
};

template <typename A, typename B>
Difference difference(std::span<const A> a, std::span<const B> b) {
  Difference result;
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d[4] = {double{a[i].r} - double{b[i].r}, double{a[i].g} - double{b[i].g},
                         double{a[i].b} - double{b[i].b}, double{a[i].a} - double{b[i].a}};
    for (const double v : d) {
      result.finite = result.finite && std::isfinite(v);
      result.largest = std::max(result.largest, std::abs(v));
      sum += v * v;
    }
  }
  result.rms = std::sqrt(sum / (4.0 * static_cast<double>(std::max<std::size_t>(a.size(), 1))));
  return result;
}

inline Difference difference(const Image<Rgba>& a, const Image<Rgba>& b) {
  return difference(a.pixels(), b.pixels());
}

inline double largestAlpha(const Image<Rgba>& image) {
  double largest = 0;
  for (const Rgba& p : image.pixels()) largest = std::max(largest, double{p.a});
  return largest;
}

}  // namespace burin::test
