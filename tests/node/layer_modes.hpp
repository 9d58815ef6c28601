#pragma once

#include <string>
#include <vector>

#include "node/reference_fixture.hpp"
#include "support/drawing.hpp"
#include "support/scenes.hpp"

/// Scenes of layers that are surfaces and projections, of smoothVolume().
namespace burin::test {

// As in brick_invariance_test.cpp; the compositor adds rounding of over alone, 1e-7.
inline constexpr double kLargest = 5e-5;
inline constexpr double kRms = 2e-6;

inline Layer isoLayer(double value, double opacity, std::vector<StyleSettings> styles) {
  Layer layer = sceneWithStyle("plain").layers[0];
  layer.mode = LayerMode::kIso;
  layer.isoValue = value;
  layer.isoOpacity = opacity;
  layer.styles = std::move(styles);
  return layer;
}

/// Of smoothVolume(): "alone", one opaque surface; "media", two that can be seen through, one of
/// them with lines of another opacity, before and behind media.
inline Scene isoScene(const std::string& name) {
  Scene scene = sceneWithStyle(name == "alone" ? "plain" : "light");
  scene.imageSize = {56, 44};
  if (name == "alone") {
    scene.layers = {isoLayer(0.6, 1, {makeStyle("light"), makeStyle("specular")})};
    return scene;
  }
  Layer lined = isoLayer(0.45, 0.3, {makeStyle("tone"), makeStyle("edges")});
  lined.lineOpacity = gentleLineOpacity();
  scene.layers.insert(scene.layers.begin(), lined);
  scene.layers.push_back(isoLayer(0.7, 0.6, {makeStyle("depth"), makeStyle("surface")}));
  return scene;
}

/// The scene with its surfaces at values that differ by that.
inline Scene withSurfacesMoved(Scene scene, double by) {
  for (Layer& layer : scene.layers)
    if (layer.isoValue) *layer.isoValue += by;
  return scene;
}

/// Per pixel, how much a picture may be off at surfaces. Where a ray meets a surface is known as
/// well as the field is, over the field's slope along the ray, which has no bound where rays graze.
/// So: the largest change of any channel if the surfaces' values differ by what a look-up rounds
/// off. The texture unit rounds coordinates to 2^-24 of a texture, here of 46 voxels at most, along
/// three axes, twice, and the field's slope is below 0.2 a voxel: 4e-6.
inline std::vector<double> surfaceSlack(const Scene& scene, node::BrickSource& source,
                                        const Camera& camera) {
  const Communicator self{MPI_COMM_SELF};
  node::Worker worker{self, scene, source, {.bricks = 1, .wholeBricks = true}};
  RankStatistics statistics;
  const Image<Rgba> there = drawFrame(worker, scene, camera, statistics);
  std::vector<double> slack(there.pixels().size());
  for (const double by : {-4e-6, 4e-6}) {
    const Scene moved = withSurfacesMoved(scene, by);
    worker.update(moved);
    const Image<Rgba> other = drawFrame(worker, moved, camera, statistics);
    for (std::size_t i = 0; i < slack.size(); ++i)
      slack[i] = std::max(
          slack[i], difference(there.pixels().subspan(i, 1), other.pixels().subspan(i, 1)).largest);
  }
  return slack;
}

/// What two pictures differ by beyond the slack; A, B: pixels with members r, g, b and a.
template <typename A, typename B>
Difference differenceBeyond(const std::vector<double>& slack, std::span<const A> a,
                            std::span<const B> b) {
  Difference beyond;
  double sum = 0;
  for (std::size_t i = 0; i < slack.size(); ++i) {
    const Difference pixel = difference(a.subspan(i, 1), b.subspan(i, 1));
    const double more = std::max(0.0, pixel.largest - slack[i]);
    beyond.finite = beyond.finite && pixel.finite;
    beyond.largest = std::max(beyond.largest, more);
    sum += more * more;
  }
  beyond.rms = std::sqrt(sum / static_cast<double>(slack.size()));
  return beyond;
}

/// One layer of that mode, kMip or kAverage, whose opacities differ from value to value.
inline Layer projectionLayer(LayerMode mode) {
  Layer layer = sceneWithStyle("plain").layers[0];
  layer.mode = mode;
  layer.transferFunction.points = {
      {0.2, {30, 90, 220}, 0}, {0.5, {60, 220, 90}, 0.25}, {0.95, {250, 60, 40}, 0.7}};
  return layer;
}

/// Media and a surface, a projection over them, a second one, and a surface on top.
inline Scene sceneOfAllModes() {
  Scene scene = isoScene("media");
  scene.layers.erase(scene.layers.begin());
  scene.layers.push_back(projectionLayer(LayerMode::kMip));
  scene.layers.push_back(projectionLayer(LayerMode::kAverage));
  scene.layers.push_back(isoLayer(0.75, 0.4, {makeStyle("light")}));
  return scene;
}

}  // namespace burin::test
