#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "burin/common/camera.hpp"
#include "burin/common/geometry.hpp"
#include "burin/common/scene.hpp"

namespace burin::node {

/// The ray of a pixel: origin + depth * direction, world space, direction scaled to eye depth 1.
struct ReferenceRay {
  glm::dvec3 origin{0};
  glm::dvec3 direction{0, 0, -1};
  bool startsAtEye = true;  ///< perspective: only depth >= 0; a parallel ray has no start
};

ReferenceRay referenceRay(const Camera& camera, int column, int row);

/// Closed interval of depths.
struct DepthInterval {
  double near = 0;
  double far = 0;
};

/// The part of the ray inside the volume's box and the scene's clip box, and on the kept side of
/// all its clip planes; nothing if that is empty or a point.
std::optional<DepthInterval> visibleInterval(const ReferenceRay& ray, const VolumeGrid& grid,
                                             const Scene& scene);

}  // namespace burin::node
