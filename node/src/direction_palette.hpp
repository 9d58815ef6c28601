#pragma once

#include <array>
#include <glm/glm.hpp>

namespace burin::node {

/// The 240 unit directions that gradients are quantised to: the centroids of the faces of a
/// pentakis dodecahedron (dodecahedron and icosahedron combined) on the unit sphere, each of its 60
/// faces split in 4 at its edges' middles. Lum and Ma after Van Gelder and Kim (1996).
///
/// They are the mirror images of three of them in the planes of the icosahedron's symmetry, 120
/// chambers on the sphere. A direction folded into the chamber where all mirrors have it on their
/// positive side has the nearest of the three for its nearest of all (direction_palette.glsl).
struct DirectionPalette {
  std::array<glm::dvec3, 3> mirrors;     ///< unit normals, towards the chamber
  std::array<glm::dvec3, 3> directions;  ///< in the chamber
};

DirectionPalette directionPalette();

}  // namespace burin::node
