#include "reference_labels.hpp"

#include <algorithm>
#include <cmath>

namespace burin::node {

double ReferenceLabels::membership(std::span<const LabelName> labels,
                                   const glm::dvec3& index) const {
  if (labels.empty()) return 1;
  const glm::dvec3 at = glm::clamp(index, glm::dvec3{0}, glm::dvec3{voxels_.grid().dims - 1});
  const glm::dvec3 lower = glm::floor(at);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step{corner & 1, corner >> 1 & 1, corner >> 2};
    const double label = voxels_.voxelAt(glm::ivec3{lower} + step);  // the last one beyond the edge
    const auto isIt = [label](const LabelName& name) { return std::get<int>(name) == label; };
    if (std::ranges::none_of(labels, isIt)) continue;
    // 1 at the corner, 0 at its opposite.
    const glm::dvec3 near = 1.0 - glm::abs(at - lower - glm::dvec3{step});
    sum += near.x * near.y * near.z;
  }
  return sum;
}

}  // namespace burin::node
