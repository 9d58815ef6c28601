#include "burin/common/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "burin/common/error.hpp"

namespace burin {

namespace {

/// Where a named view looks from. World is LPS: x to the left, y to the back, z up; azimuth 0 is in
/// front, 90 at the patient's left.
struct View {
  std::string_view name;
  double azimuthDeg;
  double elevationDeg;
};
constexpr View kViews[] = {{"anterior", 0, 0}, {"posterior", 180, 0}, {"left", 90, 0},
                           {"right", -90, 0},  {"superior", 0, 90},   {"inferior", 0, -90}};

const View& findView(std::string_view name) {
  const auto* found = std::find_if(std::begin(kViews), std::end(kViews),
                                   [&](const View& v) { return v.name == name; });
  if (found == std::end(kViews)) fail(ExitCode::kUsage, "camera.view: '{}' is unknown", name);
  return *found;
}

char resolvedUpAxis(const CameraChoice& choice, bool anatomical) {
  if (choice.upAxis == "auto") return anatomical ? 'z' : 'y';
  return choice.upAxis == "z" ? 'z' : 'y';
}

/// `offset` turned right-handed about `axis` (Rodrigues): like a growing azimuth about the up axis.
glm::dvec3 turned(const glm::dvec3& offset, const glm::dvec3& axis, double degrees) {
  const glm::dvec3 k = glm::normalize(axis);
  const double angle = glm::radians(degrees);
  return offset * std::cos(angle) + glm::cross(k, offset) * std::sin(angle) +
         k * (glm::dot(k, offset) * (1 - std::cos(angle)));
}

Camera eyeCamera(const Scene& scene, const VolumeFacts& volume, double extraAzimuthDeg) {
  const CameraChoice& choice = scene.camera;
  const glm::dvec3 target = choice.target.value_or(volume.grid.centreWorld());
  const glm::dvec3 axis =
      resolvedUpAxis(choice, volume.anatomical) == 'z' ? glm::dvec3{0, 0, 1} : glm::dvec3{0, 1, 0};
  const glm::dvec3 up = choice.upVector.value_or(axis);
  glm::dvec3 eye = *choice.eye;
  if (extraAzimuthDeg != 0) eye = target + turned(eye - target, up, extraAzimuthDeg);
  return lookAtCamera(eye, target, up, choice.verticalFovDeg, choice.zoom, choice.projection,
                      volume.grid, scene.imageSize);
}

bool needsGradient(const Layer& layer) {
  if (layer.transferFunction.isTwoDimensional()) return true;
  return std::any_of(layer.styles.begin(), layer.styles.end(), [](const StyleSettings& s) {
    const StyleSpec* spec = findStyle(s.name);
    return spec != nullptr && spec->needsGradient;
  });
}

/// The line opacities of a layer, which has some.
TransferFunction lineFunction(const Layer& layer) {
  TransferFunction lines{{}, layer.transferFunction.opacityUnitLength};
  for (const OpacityPoint& point : layer.lineOpacity)
    lines.points.push_back({point.value, Colour{}, point.opacity});
  return lines;
}

/// A segment belongs to the brick of its middle, and its ends are looked up.
int segmentGhostLayers(const Scene& scene) {
  constexpr double kMost = 4096;  // more than any texture holds; loading stops at the volume
  return static_cast<int>(std::min(std::ceil(segmentReachVoxels(scene)), kMost));
}

}  // namespace

/// The ends are half a segment away from the middle. Along no axis that is more voxels than along
/// the ray, where a voxel is at least the smallest spacing.
double segmentReachVoxels(const Scene& scene) {
  if (!scene.quality.preintegrated && !hasSurfaces(scene)) return 0;
  const CameraChoice& camera = scene.camera;
  double slope = 0;  // of the ray through a corner of the picture
  if (camera.projection == Projection::kPerspective) {
    const double side = std::min(scene.imageSize.width, scene.imageSize.height);
    slope = std::hypot(scene.imageSize.width / side, scene.imageSize.height / side) / camera.zoom;
    if (!camera.eye) slope = std::min(slope, 1.0);  // rays beyond the bounding sphere meet nothing
    slope *= std::tan(glm::radians(camera.verticalFovDeg) / 2);
  }
  return 0.5 * scene.quality.stepVoxels * std::hypot(1.0, slope);
}

bool labelsNeeded(const Scene& scene) {
  return std::any_of(scene.layers.begin(), scene.layers.end(),
                     [](const Layer& layer) { return !layer.labels.empty(); });
}

const StyleSettings* Layer::style(std::string_view styleName) const {
  const auto found = std::find_if(styles.begin(), styles.end(),
                                  [&](const StyleSettings& s) { return s.name == styleName; });
  return found == styles.end() ? nullptr : &*found;
}

bool Layer::hasLines() const {
  return std::any_of(styles.begin(), styles.end(), [](const StyleSettings& s) {
    const StyleSpec* spec = findStyle(s.name);
    return spec != nullptr && spec->passes == StylePasses::kLines;
  });
}

double Layer::isoLineOpacity() const {
  if (lineOpacity.empty()) return isoOpacity;
  return lineFunction(*this).lookUp(isoValue.value()).opacity;
}

void resolveScene(Scene& scene, const VolumeFacts& volume) {
  for (Layer& layer : scene.layers) {
    std::optional<double>& length = layer.transferFunction.opacityUnitLength;
    if (!length) length = volume.grid.smallestSpacing();
  }
  const double planes =
      2 * volume.grid.boundingRadius() / (scene.quality.stepVoxels * volume.grid.smallestSpacing());
  if (!(planes < kMostPlanes)) {
    fail(ExitCode::kUsage,
         "quality.step_voxels: {} puts {:.3g} sample planes into the volume, expected fewer than "
         "{:.3g}",
         scene.quality.stepVoxels, planes, kMostPlanes);
  }
}

Camera resolveCamera(const Scene& scene, const VolumeFacts& volume, double extraAzimuthDeg) {
  const CameraChoice& choice = scene.camera;
  if (choice.eye) return eyeCamera(scene, volume, extraAzimuthDeg);
  OrbitParameters orbit{choice.azimuthDeg,
                        choice.elevationDeg,
                        choice.verticalFovDeg,
                        choice.zoom,
                        resolvedUpAxis(choice, volume.anatomical),
                        choice.projection};
  if (choice.view) {
    const View& view = findView(*choice.view);
    orbit.azimuthDeg = view.azimuthDeg;
    orbit.elevationDeg = view.elevationDeg;
    orbit.upAxis = 'z';  // the views' names are about LPS axes, whatever the file says
  }
  orbit.azimuthDeg += extraAzimuthDeg;
  return orbitCamera(orbit, volume.grid, scene.imageSize);
}

std::vector<ClipPlane> clipPlanes(const Scene& scene) {
  std::vector<ClipPlane> planes = scene.clip;
  if (!scene.clipBox) return planes;
  const ClipBox& box = *scene.clipBox;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 unit{0};
    unit[axis] = 1;
    planes.push_back({unit, -box.min[axis], box.hasCap});
    planes.push_back({-unit, box.max[axis], box.hasCap});
  }
  return planes;
}

glm::dvec3 lightDirectionWorld(const Light& light, const Camera& camera) {
  const glm::dvec3& d = light.direction;
  if (!light.eyeSpace) return glm::normalize(d);
  return glm::normalize(d.x * camera.right + d.y * camera.up - d.z * camera.forward);
}

int ghostLayersNeeded(const Scene& scene) {
  int needed = 0;
  for (const Layer& layer : scene.layers) {
    const bool gradient = needsGradient(layer);
    if (layer.transferFunction.isTwoDimensional())
      needed = std::max(needed, findStyle("gradient")->ghostLayers);
    for (const StyleSettings& settings : layer.styles) {
      const StyleSpec* spec = findStyle(settings.name);
      BURIN_CHECK(spec != nullptr);
      if (spec->name == "halo") continue;  // by its radius, below
      // Mere settings widen the ghost layers only where a style makes use of them.
      if (spec->hasSnippet || gradient) needed = std::max(needed, spec->ghostLayers);
    }
  }
  needed = std::max(needed, static_cast<int>(std::ceil(haloReach(scene))));
  // Styles look around a segment's middle; around those of its parts where these are halved, and
  // around the place of a surface.
  const int ofSegments = segmentGhostLayers(scene);
  return scene.quality.maxError || hasSurfaces(scene) ? needed + ofSegments
                                                      : std::max(needed, ofSegments);
}

std::vector<TransferFunction> transferFunctions(const Scene& scene) {
  std::vector<TransferFunction> functions;
  for (const Layer& layer : scene.layers) {
    if (layer.mode != LayerMode::kDvr) continue;
    const TransferFunction& own = layer.transferFunction;
    functions.push_back(own.isTwoDimensional() ? own.envelope() : own);
    if (!layer.lineOpacity.empty()) functions.push_back(lineFunction(layer));
  }
  return functions;
}

GradientOperator gradientOperator(const Layer& layer) {
  const StyleSettings* own = layer.style("gradient");
  const std::string word =
      (own != nullptr ? *own : defaultSettings(*findStyle("gradient"))).word("operator");
  if (word == "sobel") return GradientOperator::kSobel;
  return word == "regression" ? GradientOperator::kRegression : GradientOperator::kCentral;
}

GradientOperatorSet gradientOperatorsNeeded(const Scene& scene) {
  GradientOperatorSet needed;
  for (const Layer& layer : scene.layers)
    if (needsGradient(layer)) needed.insert(gradientOperator(layer));
  return needed;
}

bool hasWidgets(const Scene& scene) {
  return std::ranges::any_of(
      scene.layers, [](const Layer& layer) { return layer.transferFunction.isTwoDimensional(); });
}

bool gradientNeeded(const Scene& scene) {
  return !gradientOperatorsNeeded(scene).empty();
}

bool laplacianNeeded(const Scene& scene) {
  return std::any_of(scene.layers.begin(), scene.layers.end(), [](const Layer& layer) {
    return std::any_of(layer.styles.begin(), layer.styles.end(), [](const StyleSettings& s) {
      const StyleSpec* spec = findStyle(s.name);
      return spec != nullptr && spec->needsLaplacian;
    });
  });
}

HaloNeighbourhood haloNeighbourhood(const StyleSettings& halo) {
  const double radius = halo.number("radius");
  return {radius, std::max(0.5 * radius, 1.0)};
}

bool canHaveHalo(const Layer& layer) {
  return layer.mode == LayerMode::kDvr && layer.labels.empty() &&
         !layer.transferFunction.isTwoDimensional();
}

double haloReach(const Scene& scene) {
  double reach = 0;
  for (const Layer& layer : scene.layers)
    if (const StyleSettings* halo = layer.style("halo")) {
      const HaloNeighbourhood around = haloNeighbourhood(*halo);
      reach = std::max(reach, around.radius + around.aside);
    }
  return reach;
}

bool hasSurfaces(const Scene& scene) {
  return std::any_of(scene.layers.begin(), scene.layers.end(),
                     [](const Layer& layer) { return layer.mode == LayerMode::kIso; });
}

bool hasProjections(const Scene& scene) {
  return std::any_of(scene.layers.begin(), scene.layers.end(),
                     [](const Layer& layer) { return isProjection(layer.mode); });
}

std::vector<Scene> layerGroups(const Scene& scene) {
  std::vector<Scene> groups;
  for (const Layer& layer : scene.layers) {
    if (groups.empty() || isProjection(layer.mode) ||
        isProjection(groups.back().layers.front().mode)) {
      groups.push_back(scene);
      groups.back().layers.clear();
    }
    groups.back().layers.push_back(layer);
  }
  return groups;
}

std::vector<double> projectedFrom(const Scene& scene) {
  constexpr double kAll = -std::numeric_limits<double>::infinity();
  std::vector<double> values;
  for (const Layer& layer : scene.layers) {
    const auto& points = layer.transferFunction.points;
    const auto first = std::find_if(points.begin(), points.end(),
                                    [](const TransferPoint& p) { return p.opacity > 0; });
    if (!isProjection(layer.mode) || first == points.end()) continue;
    const bool isAll = layer.mode == LayerMode::kAverage || first == points.begin();
    values.push_back(isAll ? kAll : (first - 1)->value);
  }
  return values;
}

std::vector<double> shownSurfaces(const Scene& scene) {
  std::vector<double> values;
  for (const Layer& layer : scene.layers)
    if (layer.mode == LayerMode::kIso && std::max(layer.isoOpacity, layer.isoLineOpacity()) > 0)
      values.push_back(layer.isoValue.value());
  return values;
}

}  // namespace burin
