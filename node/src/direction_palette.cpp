#include "direction_palette.hpp"

#include <cmath>

namespace burin::node {

DirectionPalette directionPalette() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  // A face's corners: a vertex of the icosahedron, two of the dodecahedron. The chamber is the half
  // of it at the first two, up to the middle of the edge between the latter.
  const glm::dvec3 apex = glm::normalize(glm::dvec3{0, 1, golden});
  const glm::dvec3 corner = glm::normalize(glm::dvec3{1 / golden, 0, golden});
  const glm::dvec3 otherCorner{-corner.x, corner.y, corner.z};
  const glm::dvec3 foot{0, 0, 1};
  const glm::dvec3 side = glm::normalize(apex + corner);
  const glm::dvec3 otherSide = glm::normalize(apex + otherCorner);
  return {{glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}, glm::normalize(glm::cross(corner, apex))},
          {glm::normalize(apex + side + otherSide), glm::normalize(side + otherSide + foot),
           glm::normalize(corner + side + foot)}};
}

}  // namespace burin::node
