#include "burin/node/reference.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <thread>

#include "burin/common/error.hpp"
#include "reference_hit.hpp"
#include "reference_labels.hpp"
#include "reference_laplacian.hpp"
#include "reference_layer.hpp"
#include "reference_pieces.hpp"
#include "reference_projection.hpp"
#include "reference_ray.hpp"
#include "reference_volume.hpp"

namespace burin::node {

namespace {

/// Halvings of a piece below which two agreeing answers may agree by chance, and after which halves
/// are as good as points.
constexpr int kFewestHalvings = 2;
constexpr int kMostHalvings = 30;

/// What a part of a ray adds, premultiplied.
struct Span {
  glm::dvec3 colour{0};
  double opacity = 0;
};

Span over(const Span& front, const Span& back) {
  return {front.colour + (1 - front.opacity) * back.colour,
          front.opacity + (1 - front.opacity) * back.opacity};
}

double difference(const Span& a, const Span& b) {
  const glm::dvec3 colour = glm::abs(a.colour - b.colour);
  return std::max({colour.r, colour.g, colour.b, std::abs(a.opacity - b.opacity)});
}

}  // namespace

struct ReferenceRenderer::State {
  State(const Scene& givenScene, BrickSource& source, const ReferenceScales& scales,
        BrickSource* labelSource);

  /// A ray in index space.
  struct Path {
    glm::dvec3 origin{0}, direction{0};  ///< per depth
    double worldPerDepth = 1;
    ReferenceView view;
    std::span<const ReferenceLayer> layers;  ///< media and surfaces that are drawn along it
  };

  ReferencePlace placeAt(const glm::dvec3& index) const;
  /// Of a segment, in index space.
  Classified sampleOf(const Path& path, const glm::dvec3& begin, const glm::dvec3& end) const;
  Span segment(const Path& path, double begin, double end) const;
  /// A layer's surface and where a ray meets it.
  struct Hit {
    double depth;
    const ReferenceLayer* layer;
  };
  /// Between two depths, in front first; of those at one depth the first layer's.
  std::vector<Hit> hits(const Path& path, double begin, double end) const;
  Span surface(const Path& path, const Hit& hit) const;
  /// Media and surfaces: `medium(begin, end)` draws what lies between two of these.
  template <typename Medium>
  Span cutBySurfaces(const Path& path, double begin, double end, const Medium& medium) const;
  /// Of the scene's step, in front first.
  std::vector<DepthInterval> segments(const DepthInterval& interval) const;
  Span stepped(const Path& path, const DepthInterval& interval) const;
  Span projected(const Path& path, const DepthInterval& interval,
                 const ReferenceProjection& projection) const;
  Span converged(const Path& path, const DepthInterval& interval) const;
  Span halved(const Path& path, double begin, double end, const Span& whole, double allowed,
              int halvings) const;
  bool meetsNan(const Path& path, double begin, double end) const;
  glm::dvec4 trace(const ReferenceRay& ray, std::span<const ReferenceLight> lights,
                   const ReferenceExtent& extent) const;

  Scene scene;
  ReferenceVolume volume;
  std::optional<ReferenceLaplacian> laplacian;  ///< if a layer needs it
  std::optional<ReferenceLabels> labels;        ///< if a layer is bound to some
  /// No transfer function is two-dimensional, no halos are cast: what shows is known by its values.
  bool isByValue;
  /// What the picture is put together from, the last one on top.
  struct Group {
    std::vector<ReferenceLayer> layers;  ///< media and surfaces, or
    std::optional<ReferenceProjection> projection;
  };
  std::vector<Group> groups;
  double stepWorld;
};

ReferenceRenderer::State::State(const Scene& givenScene, BrickSource& source,
                                const ReferenceScales& scales, BrickSource* labelSource)
    : scene{givenScene},
      volume{source},
      isByValue{!hasWidgets(scene) && haloReach(scene) == 0},
      stepWorld{scene.quality.stepVoxels * volume.grid().smallestSpacing()} {
  ReferenceGradientScale scale{volume, scales.gradients};
  for (const Scene& part : layerGroups(scene)) {
    Group& group = groups.emplace_back();
    for (const Layer& layer : part.layers) {
      if (isProjection(layer.mode))
        group.projection.emplace(layer);
      else
        group.layers.emplace_back(layer, scale);
    }
  }
  if (laplacianNeeded(scene)) laplacian.emplace(volume, scales.laplacian);
  if (!labelsNeeded(scene)) return;
  BURIN_CHECK(labelSource != nullptr);
  labels.emplace(*labelSource);
}

ReferencePlace ReferenceRenderer::State::placeAt(const glm::dvec3& index) const {
  ReferencePlace place;
  place.world = volume.grid().worldFromIndex(index);
  place.cut = referenceCut(scene, place.world, volume.grid().smallestSpacing());
  if (laplacian) place.laplacian = laplacian->at(index);
  return place;
}

/// Layers are media in the same place: extinctions add, colours mix by extinction.
Classified ReferenceRenderer::State::sampleOf(const Path& path, const glm::dvec3& begin,
                                              const glm::dvec3& end) const {
  Classified mixture{.colour = glm::dvec3{0}, .extinction = 0};
  const glm::dvec3 index = (begin + end) / 2.0;
  const auto value = volume.valueAt(index);
  if (!value) return mixture;
  const bool preintegrated = scene.quality.preintegrated;
  const double front = preintegrated ? volume.valueAt(begin).value_or(*value) : *value;
  const double back = preintegrated ? volume.valueAt(end).value_or(*value) : *value;
  ReferencePlace place = placeAt(index);
  PerGradientOperator<std::optional<glm::dvec3>> gradients;  // of the volume: for all layers
  for (const ReferenceLayer& layer : path.layers) {
    if (layer.isoValue()) continue;
    const auto lookAround = [&] {
      std::optional<glm::dvec3>& gradient = gradients[layer.gradientOperatorUsed()];
      if (layer.needsGradient() && !gradient)
        gradient = volume.gradientAt(index, layer.gradientOperatorUsed());
      place.gradient = gradient.value_or(glm::dvec3{0});
    };
    ReferenceClass classes;
    if (layer.isTwoDimensional()) {
      lookAround();
      classes = layer.classify(front, back, place.gradient);
    } else {
      classes = preintegrated ? layer.classify(front, back) : layer.classify(*value);
    }
    if (labels) classes.scale(labels->membership(layer.labels(), index));
    // No style but halos adds extinction where the transfer functions give none.
    if (!classes.shows() && layer.halo() == nullptr) continue;
    lookAround();
    if (layer.halo() != nullptr) place.halo = layer.halo()->castOn(place.world, volume, path.view);
    const Classified sample = layer.shade(classes, place, path.view);
    mixture.colour += sample.extinction * sample.colour;
    mixture.extinction += sample.extinction;
  }
  if (mixture.extinction > 0) mixture.colour /= mixture.extinction;
  return mixture;
}

std::vector<ReferenceRenderer::State::Hit> ReferenceRenderer::State::hits(const Path& path,
                                                                          double begin,
                                                                          double end) const {
  std::vector<Hit> found;
  for (const ReferenceLayer& layer : path.layers) {
    if (!layer.isoValue()) continue;
    const auto depth =
        referenceHit([&](double at) { return volume.valueAt(path.origin + at * path.direction); },
                     *layer.isoValue(), begin, end);
    if (depth) found.push_back({*depth, &layer});
  }
  std::ranges::stable_sort(found, {}, &Hit::depth);
  return found;
}

Span ReferenceRenderer::State::surface(const Path& path, const Hit& hit) const {
  const ReferenceClass classes = hit.layer->isoClass();
  if (!classes.shows()) return {};
  const glm::dvec3 index = path.origin + hit.depth * path.direction;
  ReferencePlace place = placeAt(index);
  if (hit.layer->needsGradient())
    place.gradient = volume.gradientAt(index, hit.layer->gradientOperatorUsed());
  const Classified sample = hit.layer->shade(classes, place, path.view);
  const double opacity = std::min(sample.extinction, 1.0);
  return {opacity * sample.colour, opacity};
}

template <typename Medium>
Span ReferenceRenderer::State::cutBySurfaces(const Path& path, double begin, double end,
                                             const Medium& medium) const {
  Span sum;
  double from = begin;
  for (const Hit& hit : hits(path, begin, end)) {
    sum = over(over(sum, medium(from, hit.depth)), surface(path, hit));
    from = hit.depth;
  }
  return over(sum, medium(from, end));
}

Span ReferenceRenderer::State::segment(const Path& path, double begin, double end) const {
  if (!(begin < end)) return {};
  const Classified sample =
      sampleOf(path, path.origin + begin * path.direction, path.origin + end * path.direction);
  if (sample.extinction <= 0) return {};
  const double alpha = -std::expm1(-sample.extinction * (end - begin) * path.worldPerDepth);
  return {alpha * sample.colour, alpha};
}

std::vector<DepthInterval> ReferenceRenderer::State::segments(const DepthInterval& interval) const {
  std::vector<DepthInterval> all;
  const auto first = static_cast<std::int64_t>(std::floor(interval.near / stepWorld));
  const auto last = static_cast<std::int64_t>(std::ceil(interval.far / stepWorld));
  for (std::int64_t k = first; k < last; ++k) {
    const double begin = std::max(static_cast<double>(k) * stepWorld, interval.near);
    const double end = std::min(static_cast<double>(k + 1) * stepWorld, interval.far);
    if (begin < end) all.push_back({begin, end});
  }
  return all;
}

/// At the scene's step.
Span ReferenceRenderer::State::stepped(const Path& path, const DepthInterval& interval) const {
  Span sum;
  for (const auto& [begin, end] : segments(interval)) {
    sum = over(sum, cutBySurfaces(path, begin, end,
                                  [&](double from, double to) { return segment(path, from, to); }));
    if (1 - sum.opacity < scene.quality.termination) break;
  }
  return sum;
}

Span ReferenceRenderer::State::projected(const Path& path, const DepthInterval& interval,
                                         const ReferenceProjection& projection) const {
  ReferenceProjection::Values values;
  for (const auto& [begin, end] : segments(interval))
    if (const auto value = volume.valueAt(path.origin + (begin + end) / 2 * path.direction))
      values.push_back({*value, end - begin});
  const ColourAndOpacity at = projection.of(values);
  return {at.opacity * at.colour, at.opacity};
}

/// Halved until the scene's max_error is met: half of it is for what lies behind where the ray ends
/// early, half is dealt to the pieces, all alike.
Span ReferenceRenderer::State::converged(const Path& path, const DepthInterval& interval) const {
  const std::vector<double> cuts = smoothPieces(volume, path.origin, path.direction, interval);
  const double share = *scene.quality.maxError / 2;
  const double allowed = share / static_cast<double>(cuts.size());
  Span sum;
  for (std::size_t i = 0; i + 1 < cuts.size() && 1 - sum.opacity > share; ++i) {
    sum = over(sum, cutBySurfaces(path, cuts[i], cuts[i + 1], [&](double from, double to) {
                 const Span whole = segment(path, from, to);
                 return halved(path, from, to, whole, allowed / (1 - sum.opacity), 0);
               }));
  }
  return sum;
}

/// Whether NaN voxels begin or end in a piece: its ends may count for it then where there is
/// nothing.
bool ReferenceRenderer::State::meetsNan(const Path& path, double begin, double end) const {
  if (!volume.hasNan()) return false;
  const auto isValidAt = [&](double depth) {
    return volume.valueAt(path.origin + depth * path.direction).has_value();
  };
  const bool isValid = isValidAt(begin);
  return isValidAt(begin + (end - begin) / 2) != isValid || isValidAt(end) != isValid;
}

/// A piece whose value rises or falls all the way, so that pre-integrated halves see the same
/// values as the `whole`: one that shows nothing is nothing, unless its parts' gradients count too.
Span ReferenceRenderer::State::halved(const Path& path, double begin, double end, const Span& whole,
                                      double allowed, int halvings) const {
  const bool isMixed = meetsNan(path, begin, end);
  if (isByValue && scene.quality.preintegrated && whole.opacity <= 0 && !isMixed) return whole;
  const double middle = begin + (end - begin) / 2;
  const Span front = segment(path, begin, middle);
  const Span back = segment(path, middle, end);
  const Span both = over(front, back);
  if (halvings >= kMostHalvings ||
      (halvings >= kFewestHalvings && !isMixed && difference(both, whole) <= allowed))
    return both;
  return over(halved(path, begin, middle, front, allowed, halvings + 1),
              halved(path, middle, end, back, allowed, halvings + 1));
}

glm::dvec4 ReferenceRenderer::State::trace(const ReferenceRay& ray,
                                           std::span<const ReferenceLight> lights,
                                           const ReferenceExtent& extent) const {
  const auto visible = visibleInterval(ray, volume.grid(), scene);
  if (!visible) return glm::dvec4{0};
  const double worldPerDepth = glm::length(ray.direction);
  Path path{volume.grid().indexFromWorld(ray.origin),
            volume.grid().worldToIndex() * ray.direction,
            worldPerDepth,
            ReferenceView{-ray.direction / worldPerDepth, lights, extent},
            {}};
  Span picture;
  for (const Group& group : groups) {
    path.layers = group.layers;
    const Span image = group.projection         ? projected(path, *visible, *group.projection)
                       : scene.quality.maxError ? converged(path, *visible)
                                                : stepped(path, *visible);
    picture = over(image, picture);
  }
  return {picture.colour, picture.opacity};
}

ReferenceScales surveyedScales(const VolumeSurvey& survey, const Scene& scene) {
  ReferenceScales scales;
  const GradientOperatorSet needed = gradientOperatorsNeeded(scene);
  for (const GradientOperator which : kAllGradientOperators)
    if (needed.contains(which)) scales.gradients[which] = survey.gradients[which].percentile;
  if (laplacianNeeded(scene)) scales.laplacian = survey.laplacian999;
  return scales;
}

ReferenceRenderer::ReferenceRenderer(const Scene& scene, BrickSource& source,
                                     const ReferenceScales& scales, BrickSource* labels)
    : state_{std::make_unique<State>(scene, source, scales, labels)} {}

ReferenceRenderer::~ReferenceRenderer() = default;

std::vector<glm::dvec4> ReferenceRenderer::render(const Camera& camera, int firstRow, int lastRow,
                                                  int threads) const {
  BURIN_CHECK(0 <= firstRow && firstRow <= lastRow && lastRow <= camera.image.height);
  BURIN_CHECK(threads >= 1);
  std::vector<ReferenceLight> lights;
  for (const Light& light : state_->scene.lights)
    lights.push_back({lightDirectionWorld(light, camera), light.colour.linear() * light.intensity});

  const ReferenceExtent extent{state_->volume.grid(), camera};
  const auto width = static_cast<std::size_t>(camera.image.width);
  std::vector<glm::dvec4> pixels(width * static_cast<std::size_t>(lastRow - firstRow));
  std::atomic<int> nextRow{firstRow};
  const auto drawRows = [&] {
    for (int row = nextRow++; row < lastRow; row = nextRow++) {
      auto* out = pixels.data() + width * static_cast<std::size_t>(row - firstRow);
      for (int column = 0; column < camera.image.width; ++column)
        *out++ = state_->trace(referenceRay(camera, column, row), lights, extent);
    }
  };
  std::vector<std::jthread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(drawRows);
  drawRows();
  others.clear();  // joins
  return pixels;
}

}  // namespace burin::node
