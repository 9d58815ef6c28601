#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <random>

#include "burin/common/camera.hpp"
#include "burin/common/geometry.hpp"

/// Random grids and cameras, and rays written straight from the conventions in camera.hpp.
namespace burin::test {

class Random {
 public:
  explicit Random(unsigned seed) : engine_{seed} {}
  double real(double lo, double hi) {
    return std::uniform_real_distribution<double>{lo, hi}(engine_);
  }
  int integer(int lo, int hi) { return std::uniform_int_distribution<int>{lo, hi}(engine_); }
  glm::dvec3 vector(double lo, double hi) { return {real(lo, hi), real(lo, hi), real(lo, hi)}; }
  /// Evenly distributed on the sphere.
  glm::dvec3 direction() {
    for (;;) {
      const glm::dvec3 v = vector(-1, 1);
      const double length = glm::length(v);
      if (length > 0.1 && length < 1) return v / length;
    }
  }

 private:
  std::mt19937 engine_;
};

/// Rotation that takes x, y, z to a random right-handed orthonormal frame.
inline glm::dmat3 randomRotation(Random& random) {
  const glm::dvec3 a = random.direction();
  const glm::dvec3 b = glm::normalize(glm::cross(a, random.direction()));
  return {a, b, glm::cross(a, b)};
}

enum class Axes { kAligned, kRotated, kReflected, kSheared };

inline VolumeGrid makeGrid(Random& random, glm::ivec3 dims, Axes axes) {
  VolumeGrid grid;
  grid.dims = dims;
  grid.origin = random.vector(-50, 50);
  grid.spacing = random.vector(0.4, 2.5);
  if (axes != Axes::kAligned) grid.direction = randomRotation(random);
  if (axes == Axes::kReflected) grid.direction[1] = -grid.direction[1];
  if (axes == Axes::kSheared) {  // 60 degrees between x and y instead of 90
    grid.direction[1] = 0.5 * grid.direction[0] + std::sqrt(0.75) * grid.direction[1];
  }
  return grid;
}

/// Camera with a random direction and roll, its eye `diagonals` box diagonals from a point in the
/// box.
inline Camera randomCamera(Random& random, const VolumeGrid& grid, Projection projection,
                           double diagonals, ImageSize image) {
  const Box box = grid.boxIndex();
  const glm::dvec3 size = box.hi - box.lo;
  const glm::dvec3 target = grid.worldFromIndex(box.lo + size * random.vector(0.2, 0.8));
  const glm::dvec3 eye = target + random.direction() * (2 * grid.boundingRadius() * diagonals);
  return lookAtCamera(eye, target, random.direction(), random.real(20, 100), random.real(0.5, 2),
                      projection, grid, image);
}

struct Ray {
  glm::dvec3 origin;
  glm::dvec3 direction;  ///< for one unit of depth
};

/// The ray through image position (column, row) in pixels; pixel centres are at i + 1/2.
inline Ray rayWorld(const Camera& camera, double column, double row) {
  const double x = (column - camera.image.width / 2.0) * camera.pixelSize;
  const double y = (camera.image.height / 2.0 - row) * camera.pixelSize;
  const glm::dvec3 sideways = x * camera.right + y * camera.up;
  if (camera.projection == Projection::kPerspective) {
    return {camera.eyeWorld, camera.forward + sideways};
  }
  return {camera.eyeWorld + sideways, camera.forward};
}

struct Interval {
  double begin;
  double end;
};

/// Depths at which a ray is inside a box of cells; none before a perspective eye.
inline std::optional<Interval> depthsInside(const VolumeGrid& grid, const IndexBox& cells,
                                            const Camera& camera, const Ray& ray) {
  Box box{glm::dvec3{cells.lo}, glm::dvec3{cells.hi}};
  for (int axis = 0; axis < 3; ++axis) {
    if (grid.dims[axis] == 1) box.lo[axis] = -0.5, box.hi[axis] = 0.5;
  }
  const glm::dmat3 toIndex = glm::inverse(grid.indexToWorld());
  const glm::dvec3 origin = toIndex * (ray.origin - grid.origin);
  const glm::dvec3 direction = toIndex * ray.direction;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Interval inside{camera.projection == Projection::kPerspective ? 0 : -kInfinity, kInfinity};
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < box.lo[axis] || origin[axis] > box.hi[axis]) return std::nullopt;
      continue;
    }
    const double a = (box.lo[axis] - origin[axis]) / direction[axis];
    const double b = (box.hi[axis] - origin[axis]) / direction[axis];
    inside.begin = std::max(inside.begin, std::min(a, b));
    inside.end = std::min(inside.end, std::max(a, b));
  }
  if (inside.begin >= inside.end) return std::nullopt;
  return inside;
}

}  // namespace burin::test
