#include "burin/common/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "burin/common/error.hpp"
#include "common/views.hpp"

namespace burin {
namespace {

using test::Axes;
using test::Random;

constexpr double kDegree = std::numbers::pi / 180;

VolumeGrid cube() {
  VolumeGrid grid;
  grid.dims = {65, 65, 65};
  return grid;
}

/// The formulas of the scene contract, word for word.
glm::dvec3 directionToEye(double azimuthDeg, double elevationDeg, char upAxis) {
  const double az = azimuthDeg * kDegree;
  const double el = elevationDeg * kDegree;
  if (upAxis == 'y')
    return {std::sin(az) * std::cos(el), std::sin(el), std::cos(az) * std::cos(el)};
  return {std::sin(az) * std::cos(el), -std::cos(az) * std::cos(el), std::sin(el)};
}

double distanceToRay(const glm::dvec3& point, const test::Ray& ray) {
  return glm::length(glm::cross(point - ray.origin, glm::normalize(ray.direction)));
}

TEST(OrbitCamera, FollowsTheContractsDirection) {
  const VolumeGrid grid = cube();
  for (const char upAxis : {'y', 'z'}) {
    for (double az = -400; az <= 400; az += 37) {
      for (double el = -90; el <= 90; el += 15) {
        const Camera camera = orbitCamera({az, el, 30, 1, upAxis}, grid, {64, 48});
        const glm::dvec3 toEye = directionToEye(az, el, upAxis);
        // sin and cos of angles up to 7 rad, rounded before the call: 7 * 1.1e-16 and a few more.
        EXPECT_LT(glm::length(camera.forward + toEye), 1e-14);
        const double distance = grid.boundingRadius() / std::sin(15 * kDegree);
        EXPECT_LT(glm::length(camera.eyeWorld - (grid.centreWorld() + distance * toEye)),
                  1e-14 * distance);
        // The up vector is the derivative by elevation; central differences of h = 1e-4 rad are off
        // by h^2/6 = 1.7e-9 and by 1e-16/h = 1e-12.
        const double h = 1e-4;
        const glm::dvec3 derivative = (directionToEye(az, el + h / kDegree, upAxis) -
                                       directionToEye(az, el - h / kDegree, upAxis)) /
                                      (2 * h);
        EXPECT_LT(glm::length(camera.up - derivative), 3e-9);
        EXPECT_LT(glm::length(camera.right - glm::cross(camera.forward, camera.up)), 1e-15);
        EXPECT_NEAR(glm::length(camera.right), 1, 1e-15);
      }
    }
  }
}

TEST(OrbitCamera, PolesAndQuarterTurnsAreExact) {
  const VolumeGrid grid = cube();
  const auto view = [&](double az, double el, char upAxis) {
    return orbitCamera({az, el, 30, 1, upAxis}, grid, {64, 64});
  };
  const Camera top = view(0, 90, 'y');
  EXPECT_EQ(top.forward, (glm::dvec3{0, -1, 0}));
  EXPECT_EQ(top.up, (glm::dvec3{0, 0, -1}));
  EXPECT_EQ(top.right, (glm::dvec3{1, 0, 0}));
  const Camera bottom = view(0, -90, 'y');
  EXPECT_EQ(bottom.forward, (glm::dvec3{0, 1, 0}));
  EXPECT_EQ(bottom.up, (glm::dvec3{0, 0, 1}));
  const Camera front = view(0, 0, 'z');
  EXPECT_EQ(front.forward, (glm::dvec3{0, 1, 0}));
  EXPECT_EQ(front.up, (glm::dvec3{0, 0, 1}));
  EXPECT_EQ(front.right, (glm::dvec3{1, 0, 0}));
  const Camera head = view(0, 90, 'z');
  EXPECT_EQ(head.forward, (glm::dvec3{0, 0, -1}));
  EXPECT_EQ(head.up, (glm::dvec3{0, 1, 0}));
  EXPECT_EQ(view(90, 0, 'y').forward, (glm::dvec3{-1, 0, 0}));
  EXPECT_EQ(view(180, 0, 'y').forward, (glm::dvec3{0, 0, 1}));
  EXPECT_EQ(view(-90, 0, 'y').forward, view(270, 0, 'y').forward);
}

TEST(OrbitCamera, SphereFitsTheSmallerSide) {
  Random random{3};
  for (const ImageSize image : {ImageSize{200, 120}, ImageSize{90, 150}}) {
    for (const double fov : {1.0, 30.0, 120.0}) {
      for (const double zoom : {1.0, 2.5}) {
        const VolumeGrid grid = test::makeGrid(random, {40, 30, 20}, Axes::kRotated);
        const double radius = grid.boundingRadius();
        const bool wide = image.width > image.height;
        // The middle of the edge of the smaller side.
        const double column = wide ? image.width / 2.0 : 0;
        const double row = wide ? 0 : image.height / 2.0;
        OrbitParameters orbit{20, 30, fov, zoom};
        const Camera perspective = orbitCamera(orbit, grid, image);
        const double edgeAngle = std::atan(std::tan(fov / 2 * kDegree) / zoom);
        const double expected = radius / std::sin(fov / 2 * kDegree) * std::sin(edgeAngle);
        // Positions of up to 115 R (fov 1 degree) in double: 115 * 1e-16 * a few.
        EXPECT_NEAR(distanceToRay(grid.centreWorld(), test::rayWorld(perspective, column, row)),
                    expected, 1e-12 * radius);
        if (zoom == 1) {
          EXPECT_NEAR(expected, radius, 1e-12 * radius);
        }
        orbit.projection = Projection::kOrthographic;
        const Camera parallel = orbitCamera(orbit, grid, image);
        EXPECT_NEAR(distanceToRay(grid.centreWorld(), test::rayWorld(parallel, column, row)),
                    radius / zoom, 1e-12 * radius);
        EXPECT_EQ(parallel.eyeWorld, perspective.eyeWorld);
      }
    }
  }
}

TEST(LookAtCamera, AgreesWithTheOrbit) {
  const VolumeGrid grid = cube();
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    const Camera orbit = orbitCamera({25, 40, 35, 1.5, 'y', projection}, grid, {80, 60});
    const Camera camera = lookAtCamera(orbit.eyeWorld, grid.centreWorld(), {0, 3, 0}, 35, 1.5,
                                       projection, grid, {80, 60});
    EXPECT_LT(glm::length(camera.forward - orbit.forward), 1e-14);
    EXPECT_LT(glm::length(camera.up - orbit.up), 1e-14);
    EXPECT_LT(glm::length(camera.right - orbit.right), 1e-14);
    EXPECT_EQ(camera.eyeWorld, orbit.eyeWorld);
    EXPECT_EQ(camera.pixelSize, orbit.pixelSize);
  }
}

TEST(LookAtCamera, RejectsViewsWithoutADirection) {
  const auto message = [](const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
    try {
      lookAtCamera(eye, target, up, 30, 1, Projection::kPerspective, cube(), {8, 8});
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage);
      return std::string{error.what()};
    }
    return std::string{};
  };
  EXPECT_NE(message({1, 2, 3}, {1, 2, 3}, {0, 1, 0}).find("eye and target"), std::string::npos);
  EXPECT_NE(message({0, 0, 9}, {0, 0, 0}, {0, 0, -2}).find("parallel"), std::string::npos);
  EXPECT_NE(message({0, 0, 9}, {0, 0, 0}, {0, 0, 0}).find("parallel"), std::string::npos);
  EXPECT_NE(message({0, 0, std::nan("")}, {0, 0, 0}, {0, 1, 0}).find("eye"), std::string::npos);
  EXPECT_EQ(message({0, 0, 9}, {0, 0, 0}, {0, 1, 1}), "");
}

}  // namespace
}  // namespace burin
