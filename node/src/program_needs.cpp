#include "program_needs.hpp"

#include <algorithm>

namespace burin::node {

std::vector<ClipPlane> cappedPlanes(const Scene& scene) {
  const auto seesCuts = [](const StyleSettings& s) { return findStyle(s.name)->seesCuts; };
  const bool anySees = std::ranges::any_of(scene.layers, [&](const Layer& layer) {
    return std::ranges::any_of(layer.styles, seesCuts);
  });
  std::vector<ClipPlane> planes = clipPlanes(scene);
  std::erase_if(planes, [&](const ClipPlane& plane) { return !anySees || !plane.hasCap; });
  return planes;
}

bool isAdaptive(const Quality& quality) {
  return quality.maxError && quality.preintegrated;
}

bool needsNeighbourhood(const GradientOperatorSet& operators) {
  return !GradientOperatorSet{GradientOperator::kCentral}.contains(operators);
}

bool quantisesNormals(const Scene& scene) {
  return scene.quality.normals == Normals::kQuantised && gradientNeeded(scene);
}

}  // namespace burin::node
