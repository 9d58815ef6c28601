#include "burin/node/reference.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <thread>

#include "burin/common/error.hpp"
#include "reference_layer.hpp"
#include "reference_ray.hpp"
#include "reference_volume.hpp"

namespace burin::node {

struct ReferenceRenderer::State {
  State(const Scene& givenScene, BrickSource& source, const std::optional<double>& gradientScale);

  /// Of a segment, in index space.
  Classified sampleOf(const glm::dvec3& begin, const glm::dvec3& end,
                      const ReferenceView& view) const;
  glm::dvec4 trace(const ReferenceRay& ray, std::span<const ReferenceLight> lights) const;

  Scene scene;
  ReferenceVolume volume;
  std::vector<ReferenceLayer> layers;
  double stepWorld;
};

ReferenceRenderer::State::State(const Scene& givenScene, BrickSource& source,
                                const std::optional<double>& gradientScale)
    : scene{givenScene},
      volume{source},
      stepWorld{scene.quality.stepVoxels * volume.grid().smallestSpacing()} {
  ReferenceGradientScale scale{volume, gradientScale};
  for (const Layer& layer : scene.layers) layers.emplace_back(layer, scale);
}

/// Layers are media in the same place: extinctions add, colours mix by extinction.
Classified ReferenceRenderer::State::sampleOf(const glm::dvec3& begin, const glm::dvec3& end,
                                              const ReferenceView& view) const {
  Classified mixture{.colour = glm::dvec3{0}, .extinction = 0};
  const glm::dvec3 index = (begin + end) / 2.0;
  const auto value = volume.valueAt(index);
  if (!value) return mixture;
  const bool preintegrated = scene.quality.preintegrated;
  const double front = preintegrated ? volume.valueAt(begin).value_or(*value) : *value;
  const double back = preintegrated ? volume.valueAt(end).value_or(*value) : *value;
  std::optional<glm::dvec3> gradient;  // of the volume: the same for all layers
  for (const ReferenceLayer& layer : layers) {
    const Classified plain = preintegrated ? layer.classify(front, back) : layer.classify(*value);
    // No style adds extinction where the transfer function gives none.
    if (plain.extinction <= 0) continue;
    if (layer.needsGradient() && !gradient) gradient = volume.gradientAt(index);
    const Classified sample = layer.shade(plain, gradient.value_or(glm::dvec3{0}), view);
    mixture.colour += sample.extinction * sample.colour;
    mixture.extinction += sample.extinction;
  }
  if (mixture.extinction > 0) mixture.colour /= mixture.extinction;
  return mixture;
}

glm::dvec4 ReferenceRenderer::State::trace(const ReferenceRay& ray,
                                           std::span<const ReferenceLight> lights) const {
  glm::dvec3 colour{0};
  double opacity = 0;
  const auto visible = visibleInterval(ray, volume.grid(), scene.clip);
  if (!visible) return glm::dvec4{0};
  const double worldPerDepth = glm::length(ray.direction);
  const ReferenceView view{-ray.direction / worldPerDepth, lights};
  const glm::dvec3 originIndex = volume.grid().indexFromWorld(ray.origin);
  const glm::dvec3 directionIndex = volume.grid().worldToIndex() * ray.direction;
  const auto first = static_cast<std::int64_t>(std::floor(visible->near / stepWorld));
  const auto last = static_cast<std::int64_t>(std::ceil(visible->far / stepWorld));
  for (std::int64_t k = first; k < last; ++k) {
    const double begin = std::max(static_cast<double>(k) * stepWorld, visible->near);
    const double end = std::min(static_cast<double>(k + 1) * stepWorld, visible->far);
    if (!(begin < end)) continue;
    const Classified sample =
        sampleOf(originIndex + begin * directionIndex, originIndex + end * directionIndex, view);
    if (sample.extinction <= 0) continue;
    const double alpha = -std::expm1(-sample.extinction * (end - begin) * worldPerDepth);
    colour += (1 - opacity) * alpha * sample.colour;
    opacity += (1 - opacity) * alpha;
    if (1 - opacity < scene.quality.termination) break;
  }
  return {colour, opacity};
}

ReferenceRenderer::ReferenceRenderer(const Scene& scene, BrickSource& source,
                                     std::optional<double> gradientScale)
    : state_{std::make_unique<State>(scene, source, gradientScale)} {}

ReferenceRenderer::~ReferenceRenderer() = default;

std::vector<glm::dvec4> ReferenceRenderer::render(const Camera& camera, int firstRow, int lastRow,
                                                  int threads) const {
  BURIN_CHECK(0 <= firstRow && firstRow <= lastRow && lastRow <= camera.image.height);
  BURIN_CHECK(threads >= 1);
  std::vector<ReferenceLight> lights;
  for (const Light& light : state_->scene.lights)
    lights.push_back({lightDirectionWorld(light, camera), light.colour.linear() * light.intensity});

  const auto width = static_cast<std::size_t>(camera.image.width);
  std::vector<glm::dvec4> pixels(width * static_cast<std::size_t>(lastRow - firstRow));
  std::atomic<int> nextRow{firstRow};
  const auto drawRows = [&] {
    for (int row = nextRow++; row < lastRow; row = nextRow++) {
      auto* out = pixels.data() + width * static_cast<std::size_t>(row - firstRow);
      for (int column = 0; column < camera.image.width; ++column)
        *out++ = state_->trace(referenceRay(camera, column, row), lights);
    }
  };
  std::vector<std::jthread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(drawRows);
  drawRows();
  others.clear();  // joins
  return pixels;
}

}  // namespace burin::node
