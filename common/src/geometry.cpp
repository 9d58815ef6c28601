#include "burin/common/geometry.hpp"

#include <algorithm>

namespace burin {

std::size_t IndexBox::count() const {
  if (empty()) return 0;
  const glm::ivec3 n = size();
  return static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) *
         static_cast<std::size_t>(n.z);
}

bool IndexBox::contains(const IndexBox& other) const {
  return glm::all(glm::lessThanEqual(lo, other.lo)) &&
         glm::all(glm::greaterThanEqual(hi, other.hi));
}

IndexBox intersection(const IndexBox& a, const IndexBox& b) {
  return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
}

std::size_t VolumeGrid::voxelCount() const {
  return IndexBox{glm::ivec3{0}, dims}.count();
}

glm::ivec3 VolumeGrid::cells() const {
  return glm::max(dims - 1, glm::ivec3{1});
}

Box VolumeGrid::boxIndex() const {
  return cellBoxIndex({glm::ivec3{0}, cells()});
}

Box VolumeGrid::cellBoxIndex(const IndexBox& cellRange) const {
  Box box{glm::dvec3{cellRange.lo}, glm::dvec3{cellRange.hi}};
  for (int axis = 0; axis < 3; ++axis) {
    if (dims[axis] > 1) continue;
    box.lo[axis] -= 0.5;  // the only cell of this axis is centred on its only sample
    box.hi[axis] -= 0.5;
  }
  return box;
}

glm::dvec3 VolumeGrid::centreIndex() const {
  const Box box = boxIndex();
  return 0.5 * (box.lo + box.hi);
}

glm::dmat3 VolumeGrid::indexToWorld() const {
  return {direction[0] * spacing[0], direction[1] * spacing[1], direction[2] * spacing[2]};
}

glm::dmat3 VolumeGrid::worldToIndex() const {
  // The spacing is divided out on its own: the determinant of the product may underflow.
  glm::dmat3 inverse = glm::inverse(direction);
  for (int column = 0; column < 3; ++column) inverse[column] /= spacing;
  return inverse;
}

glm::dvec3 VolumeGrid::worldFromIndex(const glm::dvec3& index) const {
  return origin + indexToWorld() * index;
}

glm::dvec3 VolumeGrid::indexFromWorld(const glm::dvec3& world) const {
  return worldToIndex() * (world - origin);
}

glm::dvec3 VolumeGrid::centreWorld() const {
  return worldFromIndex(centreIndex());
}

double VolumeGrid::boundingRadius() const {
  const Box box = boxIndex();
  const glm::dmat3 toWorld = indexToWorld();
  const glm::dvec3 half = 0.5 * (box.hi - box.lo);
  double radius = 0;
  for (int corner = 0; corner < 4; ++corner) {  // the other four are their opposites
    const glm::dvec3 sign{(corner & 1) != 0 ? -1 : 1, (corner & 2) != 0 ? -1 : 1, 1};
    radius = std::max(radius, glm::length(toWorld * (sign * half)));
  }
  return radius;
}

double VolumeGrid::smallestSpacing() const {
  return std::min({spacing.x, spacing.y, spacing.z});
}

}  // namespace burin
