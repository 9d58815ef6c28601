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
template <typename Pixel>
Image<Pixel> wholeFrame(const compositor::Subimage<Pixel>& subimage) {
  Image<Pixel> image{subimage.frame};
  const PixelRect& active = subimage.active;
  const auto width = static_cast<std::size_t>(active.width());
  for (int y = active.y0; y < active.y1; ++y)
    std::copy_n(subimage.pixels.begin() +
                    static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y - active.y0) * width),
                width, image.row(y).begin() + active.x0);
  return image;
}

/// The images of a scene's groups, of a worker that is alone.
inline std::vector<node::GroupImage> drawGroups(node::Worker& worker, const Scene& scene,
                                                const Camera& camera, RankStatistics& statistics) {
  std::vector<node::GroupImage> images;
  for (const Scene& group : layerGroups(scene)) {
    const std::size_t number = images.size();
    if (group.layers.front().mode == LayerMode::kMip) {
      images.emplace_back(wholeFrame(worker.drawLargest(camera, statistics, number)));
    } else if (group.layers.front().mode == LayerMode::kAverage) {
      images.emplace_back(wholeFrame(worker.drawSums(camera, statistics, number)));
    } else {
      compositor::Subimage<Rgba> image{camera.image, {}, {}};
      const auto room = [&](std::size_t pixels) {
        image.pixels.resize(pixels);
        return std::span{image.pixels};
      };
      image.active = worker.draw(camera, statistics, room, nullptr, number).active;
      images.emplace_back(wholeFrame(image));
    }
  }
  return images;
}

/// The frame of a worker that is alone.
inline Image<Rgba> drawFrame(node::Worker& worker, const Scene& scene, const Camera& camera,
                             RankStatistics& statistics) {
  const std::vector<node::GroupImage> images = drawGroups(worker, scene, camera, statistics);
  if (images.size() == 1 && std::holds_alternative<Image<Rgba>>(images.front()))
    return std::get<Image<Rgba>>(images.front());
  return worker.merge(images);
}

/// Draws on this process alone.
inline Image<Rgba> drawAlone(const Scene& scene, node::BrickSource& source, const Camera& camera,
                             const node::WorkerOptions& options = {},
                             RankStatistics* statistics = nullptr) {
  const Communicator self{MPI_COMM_SELF};
  node::Worker worker{self, scene, source, options};
  RankStatistics local;
  return drawFrame(worker, scene, camera, statistics != nullptr ? *statistics : local);
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
