#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "burin/host/frame_maker.hpp"

namespace burin::test {

/// Opacity from 0 to `opacity` over [first, last] of the kind's values: smooth, or a narrow spike.
struct Case {
  const char* procedural;
  double first, last, opacity;
  bool spike;
  int dims = 28;
};

inline TransferFunction functionOf(const Case& c) {
  if (c.spike)
    return {.points = {{c.first, {255, 160, 60}, 0},
                       {(c.first + c.last) / 2, {255, 160, 60}, c.opacity},
                       {c.last, {255, 160, 60}, 0}}};
  return {.points = {{c.first, {60, 90, 200}, 0}, {c.last, {250, 220, 160}, c.opacity}}};
}

/// A case's scene over these voxels.
inline host::PreparedScene prepared(const Case& c, std::unique_ptr<node::BrickSource> source) {
  host::PreparedScene made;
  made.source = std::move(source);
  made.facts = {made.source->info().grid, false};
  Layer layer;
  layer.name = c.procedural;
  layer.transferFunction = functionOf(c);
  made.scene.layers = {layer};
  made.scene.imageSize = {64, 64};
  resolveScene(made.scene, made.facts);
  return made;
}

inline host::PreparedScene prepared(const Case& c) {
  VolumeChoice choice;
  choice.procedural = c.procedural;
  choice.dims = glm::ivec3{c.dims};
  host::PreparedScene made = prepared(c, node::openVolume(choice));
  made.scene.volume = choice;
  return made;
}

inline double largestDifference(ImageView<const Rgba> a, ImageView<const Rgba> b) {
  double largest = 0;
  for (std::size_t i = 0; i < b.pixels().size(); ++i) {
    const Rgba& p = a.pixels()[i];
    const Rgba& q = b.pixels()[i];
    for (const float d : {p.r - q.r, p.g - q.g, p.b - q.b, p.a - q.a})
      largest = std::max(largest, std::abs(double{d}));
  }
  return largest;
}

/// Collective. A view of a case, pre-integrated or not, on rank 0.
inline Image<Rgba> drawn(const Communicator& comm, host::PreparedScene& scene, double asked,
                         bool preintegrated, const node::WorkerOptions& options = {}) {
  scene.scene.quality = Quality{};
  scene.scene.quality.maxError = asked;
  scene.scene.quality.preintegrated = preintegrated;
  const Camera camera = resolveCamera(scene.scene, scene.facts);
  RankStatistics unused;
  const auto frames = host::makeRaycastFrames(comm, scene, options, {});
  const ImageView<const Rgba> picture = frames->make(camera, unused);
  Image<Rgba> copy{picture.size()};
  std::ranges::copy(picture.pixels(), copy.pixels().begin());
  return copy;
}

}  // namespace burin::test
