#pragma once

#include <algorithm>
#include <array>
#include <glm/glm.hpp>
#include <span>

#include "burin/common/camera.hpp"

namespace burin::node {

/// A light as the styles meet it.
struct ReferenceLight {
  glm::dvec3 toLight{0, 0, 1};  ///< unit, world space
  glm::dvec3 radiance{1};       ///< linear colour times intensity
};

/// The volume's box as the camera sees it: what positions of samples are measured by.
class ReferenceExtent {
 public:
  ReferenceExtent(const VolumeGrid& grid, const Camera& camera)
      : forward_{camera.forward}, right_{camera.right}, up_{camera.up} {
    const Box box = grid.boxIndex();
    for (std::size_t i = 0; i < corners_.size(); ++i)
      corners_[i] = grid.worldFromIndex({(i & 1) != 0 ? box.hi.x : box.lo.x,
                                         (i & 2) != 0 ? box.hi.y : box.lo.y,
                                         (i & 4) != 0 ? box.hi.z : box.lo.z});
    centre_ = (corners_.front() + corners_.back()) / 2.0;
    for (const glm::dvec3& corner : corners_)
      radius_ = std::max(radius_, glm::distance(corner, centre_));
  }

  /// Unit directions of the picture's plane, world space.
  const glm::dvec3& right() const { return right_; }
  const glm::dvec3& up() const { return up_; }

  /// Planar depth of a world position, 0 where the bounding sphere begins, 1 where it ends.
  double depth(const glm::dvec3& world) const {
    const double behindCentre = glm::dot(world - centre_, forward_);
    return std::clamp((behindCentre + radius_) / (2 * radius_), 0.0, 1.0);
  }

  /// How far along a direction (of any length) between the box's outermost corners, 0 … 1.
  double along(const glm::dvec3& world, const glm::dvec3& direction) const {
    double first = glm::dot(corners_.front(), direction);
    double last = first;
    for (const glm::dvec3& corner : corners_) {
      first = std::min(first, glm::dot(corner, direction));
      last = std::max(last, glm::dot(corner, direction));
    }
    return std::clamp((glm::dot(world, direction) - first) / (last - first), 0.0, 1.0);
  }

 private:
  glm::dvec3 forward_, right_, up_;
  std::array<glm::dvec3, 8> corners_;
  glm::dvec3 centre_{0};
  double radius_ = 0;
};

/// Where samples are seen from and lit from.
struct ReferenceView {
  glm::dvec3 toEye{0, 0, 1};  ///< unit, world space
  std::span<const ReferenceLight> lights;
  const ReferenceExtent& extent;
};

/// The direction-dependent facts of one sample.
struct ReferenceFacing {
  glm::dvec3 normal{0};   ///< unit, or zero where the gradient is
  double magnitude = 0;   ///< m, in [0, 1]
  double confidence = 0;  ///< q(m)
};

}  // namespace burin::node
