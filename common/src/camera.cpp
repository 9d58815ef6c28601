#include "burin/common/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "burin/common/error.hpp"

namespace burin {

namespace {

struct SinCos {
  double sin;
  double cos;
};

/// Exact at multiples of 90 degrees, so that axis-parallel views have axis-parallel vectors.
SinCos sinCosDegrees(double degrees) {
  int quarters = 0;
  const double rest = std::remquo(degrees, 90.0, &quarters) * (std::numbers::pi / 180.0);
  const double s = std::sin(rest);
  const double c = std::cos(rest);
  switch (quarters & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double halfAngle(double fovDeg) {
  return 0.5 * fovDeg * (std::numbers::pi / 180.0);
}

double pixelSizeOf(Projection projection, double fovDeg, double zoom, double radius,
                   ImageSize image) {
  BURIN_CHECK(image.width > 0 && image.height > 0);
  BURIN_CHECK(zoom > 0);
  BURIN_CHECK(fovDeg > 0 && fovDeg < 180);
  const double halfSide =
      projection == Projection::kPerspective ? std::tan(halfAngle(fovDeg)) : radius;
  return 2.0 * halfSide / zoom / std::min(image.width, image.height);
}

}  // namespace

Camera orbitCamera(const OrbitParameters& orbit, const VolumeGrid& grid, ImageSize image) {
  BURIN_CHECK(orbit.upAxis == 'y' || orbit.upAxis == 'z');
  const auto [sinAz, cosAz] = sinCosDegrees(orbit.azimuthDeg);
  const auto [sinEl, cosEl] = sinCosDegrees(orbit.elevationDeg);
  glm::dvec3 toEye{sinAz * cosEl, sinEl, cosAz * cosEl};
  glm::dvec3 up{-sinAz * sinEl, cosEl, -cosAz * sinEl};  // derivative by elevation
  if (orbit.upAxis == 'z') {
    toEye = {toEye.x, -toEye.z, toEye.y};
    up = {up.x, -up.z, up.y};
  }
  const double radius = grid.boundingRadius();
  Camera camera;
  camera.projection = orbit.projection;
  camera.pixelSize = pixelSizeOf(orbit.projection, orbit.verticalFovDeg, orbit.zoom, radius, image);
  camera.image = image;
  camera.forward = -toEye;
  camera.up = up;
  camera.right = glm::cross(camera.forward, up);
  camera.eyeWorld = grid.centreWorld() + radius / std::sin(halfAngle(orbit.verticalFovDeg)) * toEye;
  return camera;
}

Camera lookAtCamera(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up,
                    double verticalFovDeg, double zoom, Projection projection,
                    const VolumeGrid& grid, ImageSize image) {
  const glm::dvec3 view = target - eye;
  const double distance = glm::length(view);
  if (!(distance > 0) || !std::isfinite(distance)) {
    fail(ExitCode::kUsage,
         "camera: eye and target must be two different points, both are {}, {}, {}", eye.x, eye.y,
         eye.z);
  }
  const glm::dvec3 forward = view / distance;
  // Below 1e-9 rad between up and view, rounding would decide which way the picture is turned.
  const glm::dvec3 side = glm::cross(forward, up);
  if (!(glm::length(side) > 1e-9 * glm::length(up))) {
    fail(ExitCode::kUsage,
         "camera: up ({}, {}, {}) must not be zero or parallel to the view from eye to target",
         up.x, up.y, up.z);
  }
  Camera camera;
  camera.projection = projection;
  camera.pixelSize = pixelSizeOf(projection, verticalFovDeg, zoom, grid.boundingRadius(), image);
  camera.image = image;
  camera.eyeWorld = eye;
  camera.forward = forward;
  camera.right = glm::normalize(side);
  camera.up = glm::cross(camera.right, forward);
  return camera;
}

}  // namespace burin
