#pragma once

#include <glm/glm.hpp>

namespace burin::node {

/// A head as a CT scanner would see it, in Hounsfield units from -1024 to about 1700, all borders
/// smooth: skin, fat, skull with orbits and a nose, eyes, brain with ventricles and a bright
/// lesion. p in the unit cube: +y up, +z to the front, +x to the head's left.
double ctPhantomHounsfield(const glm::dvec3& p);

/// The phantom's segmentation: 0 nothing, 1 soft tissue, 2 bone and teeth, 3 brain, 4 ventricles,
/// 5 lesion, 6 eyes.
int ctPhantomLabel(const glm::dvec3& p);

}  // namespace burin::node
