#pragma once

#include <glm/glm.hpp>

#include "burin/common/geometry.hpp"

namespace burin {

enum class Projection { kPerspective, kOrthographic };

struct ImageSize {
  int width = 0;
  int height = 0;
  std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  friend bool operator==(const ImageSize&, const ImageSize&) = default;
};

/// A resolved camera in world space. right, up, forward are orthonormal.
///
/// Pixel (column i, row j), row 0 at the top, has image-plane coordinates
///   x = (i + 1/2 - width/2) * pixelSize,   y = (height/2 - (j + 1/2)) * pixelSize.
/// Perspective: its ray is eye + depth * (forward + x*right + y*up), depth >= 0, pixelSize without
/// unit (image plane at depth 1). Orthographic: the ray is eye + x*right + y*up + depth * forward,
/// depth any real number (a parallel view has no near side), pixelSize in world units.
struct Camera {
  Projection projection = Projection::kPerspective;
  glm::dvec3 eyeWorld{0};
  glm::dvec3 right{1, 0, 0};
  glm::dvec3 up{0, 1, 0};
  glm::dvec3 forward{0, 0, -1};
  double pixelSize = 1;
  ImageSize image;
};

/// The orbit camera of the scene contract. `verticalUp`: 'y' or 'z', the world axis that is up.
struct OrbitParameters {
  double azimuthDeg = 0;
  double elevationDeg = 0;
  double verticalFovDeg = 30;  ///< of the *smaller* image side
  double zoom = 1;
  char upAxis = 'y';
  Projection projection = Projection::kPerspective;
};

/// Camera that looks at the volume's centre from distance R/sin(fov/2), so that the bounding sphere
/// fits the smaller image side at zoom 1. Works at elevation ±90°: up is the derivative of the
/// direction by elevation.
Camera orbitCamera(const OrbitParameters& orbit, const VolumeGrid& grid, ImageSize image);

/// Camera from an explicit eye, target and up vector (world). Throws Error{kUsage} if eye equals
/// target or up is parallel to the view. Orthographic: the smaller image side shows 2R/zoom.
Camera lookAtCamera(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up,
                    double verticalFovDeg, double zoom, Projection projection,
                    const VolumeGrid& grid, ImageSize image);

}  // namespace burin
