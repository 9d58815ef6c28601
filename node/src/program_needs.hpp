#pragma once

#include <vector>

#include "burin/common/scene.hpp"

namespace burin::node {

/// The clip planes whose cuts some style shades.
std::vector<ClipPlane> cappedPlanes(const Scene& scene);

/// Whether segments are halved until they are right, instead of taken as they are.
bool isAdaptive(const Quality& quality);

/// Whether operators look at more than the six face neighbours.
bool needsNeighbourhood(const GradientOperatorSet& operators);

bool quantisesNormals(const Scene& scene);

}  // namespace burin::node
