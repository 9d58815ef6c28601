#include "bench/rate_scenes.hpp"

#include <algorithm>
#include <cmath>

#include "burin/common/error.hpp"

namespace burin::host::bench {

namespace {

constexpr double kTranslucent = 0.03;
/// Shows at any step, and hides nothing.
constexpr double kFaint = 1e-4;

StyleSettings withDefaults(std::string_view style) {
  const StyleSpec* spec = findStyle(style);
  BURIN_CHECK(spec != nullptr);
  return defaultSettings(*spec);
}

/// World units from one pixel's ray to the next at the volume's centre.
double pixelWorld(const Camera& camera, const VolumeGrid& grid) {
  if (camera.projection == Projection::kOrthographic) return camera.pixelSize;
  return camera.pixelSize * glm::dot(grid.centreWorld() - camera.eyeWorld, camera.forward);
}

/// Keeps all of the volume.
ClipPlane moved(ClipPlane plane, const VolumeGrid& grid) {
  plane.offset = 2 * glm::length(plane.normal) * grid.boundingRadius() -
                 glm::dot(plane.normal, grid.centreWorld());
  return plane;
}

}  // namespace

const char* name(Look look) {
  return look == Look::kOpaque ? "opaque" : "translucent";
}

const char* name(Shading shading) {
  return shading == Shading::kPlain ? "plain" : "tone-edges";
}

Scene drawnAs(Scene scene, Look look, Shading shading) {
  for (Layer& layer : scene.layers) {
    layer.styles.clear();
    if (shading == Shading::kToneEdges)
      layer.styles = {withDefaults("tone"), withDefaults("edges")};
    if (look == Look::kOpaque) continue;
    for (TransferPoint& point : layer.transferFunction.points) point.opacity *= kTranslucent;
  }
  return scene;
}

Scene withAllLanesBusy(Scene scene, const VolumeFacts& facts) {
  const VolumeGrid& grid = facts.grid;
  const double pixel = pixelWorld(resolveCamera(scene, facts), grid);
  const glm::dmat3 axes = grid.indexToWorld();
  const Box box = grid.boxIndex();
  const auto pixelsAlong = [&](int axis) {
    const double length = (box.hi[axis] - box.lo[axis]) * glm::length(axes[axis]);
    return static_cast<int>(std::clamp(length / pixel, 1.0, double{kLargestImageSide}));
  };
  scene.imageSize = {pixelsAlong(0), pixelsAlong(1)};
  scene.camera = {};
  scene.camera.projection = Projection::kOrthographic;
  scene.camera.eye = grid.centreWorld() + axes[2];
  scene.camera.upVector = axes[1];
  scene.camera.zoom =
      2 * grid.boundingRadius() / (pixel * std::min(scene.imageSize.width, scene.imageSize.height));
  scene.quality.termination = 0;
  for (Layer& layer : scene.layers)
    for (TransferPoint& point : layer.transferFunction.points)
      point.opacity = std::max(point.opacity, kFaint);
  for (ClipPlane& plane : scene.clip) plane = moved(plane, grid);
  return scene;
}

}  // namespace burin::host::bench
