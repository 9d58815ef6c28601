#include "burin/common/sample_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "burin/common/error.hpp"
#include "common/views.hpp"

namespace burin {
namespace {

using test::Axes;
using test::Random;
using Wide = glm::vec<3, long double>;
using WideMatrix = glm::mat<3, 3, long double>;

constexpr ImageSize kLatticeImage{200, 120};

/// The position the conventions ask for, in centred index space, straight from the eye in 64-bit
/// mantissas: eye + k * step * (forward + x right + y up), taken to the volume's own axes.
Wide exactPosition(const Camera& camera, const VolumeGrid& grid, double stepWorld, std::int64_t k,
                   double column, double row) {
  const long double pixel = camera.pixelSize;
  const long double x = (column - kLatticeImage.width / 2.0L) * pixel;
  const long double y = (kLatticeImage.height / 2.0L - row) * pixel;
  const long double depth = static_cast<long double>(k) * stepWorld;
  const long double spread = camera.projection == Projection::kPerspective ? depth : 1.0L;
  const Wide world = Wide{camera.eyeWorld} + depth * Wide{camera.forward} +
                     spread * (x * Wide{camera.right} + y * Wide{camera.up});
  WideMatrix toWorld{grid.direction};
  for (int axis = 0; axis < 3; ++axis)
    toWorld[axis] *= static_cast<long double>(grid.spacing[axis]);
  return glm::inverse(toWorld) * (world - Wide{grid.origin}) - Wide{grid.centreIndex()};
}

template <typename T>
glm::vec<3, T> latticePosition(const SampleLattice& lattice, T fx, T fy, T j) {
  using Vector = glm::vec<3, T>;
  const Vector onReference =
      Vector{lattice.base} + fx * Vector{lattice.baseX} + fy * Vector{lattice.baseY};
  const Vector perPlane =
      Vector{lattice.step} + fx * Vector{lattice.stepX} + fy * Vector{lattice.stepY};
  return onReference + j * perPlane;
}

/// Largest distance in voxels, over random pixels and the planes inside the volume, between the
/// lattice evaluated in T and the exact position.
template <typename T>
double worstError(const Camera& camera, const VolumeGrid& grid, double stepVoxels, Random& random) {
  const SampleLattice lattice = makeSampleLattice(camera, grid, stepVoxels);
  const int planes = static_cast<int>(grid.boundingRadius() / lattice.stepWorld);
  const glm::dvec3 half = 0.5 * (grid.boxIndex().hi - grid.boxIndex().lo);
  double worst = -1;
  for (int i = 0; i < 4000; ++i) {
    const int column = random.integer(0, kLatticeImage.width - 1);
    const int row = random.integer(0, kLatticeImage.height - 1);
    const double j =
        std::max(static_cast<double>(random.integer(-planes, planes)), lattice.nearPlane);
    const Wide exact = exactPosition(camera, grid, lattice.stepWorld,
                                     lattice.reference + std::llround(j), column + 0.5, row + 0.5);
    if (glm::any(glm::greaterThan(glm::abs(glm::dvec3{exact}), half))) continue;
    const auto position = latticePosition<T>(
        lattice, static_cast<T>(column + 0.5 - kLatticeImage.width / 2.0),
        static_cast<T>(row + 0.5 - kLatticeImage.height / 2.0), static_cast<T>(j));
    worst = std::max(worst, static_cast<double>(glm::length(Wide{position} - exact)));
  }
  EXPECT_GE(worst, 0) << "no sample was inside the volume";
  return worst;
}

TEST(SampleLattice, EqualsTheDirectFormulaInDouble) {
  Random random{10};
  for (const Axes axes : {Axes::kAligned, Axes::kRotated, Axes::kReflected, Axes::kSheared}) {
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      for (const double diagonals : {0.0001, 0.4, 3.0, 1000.0}) {
        const VolumeGrid grid = test::makeGrid(random, {60, 80, 50}, axes);
        Camera camera = test::randomCamera(random, grid, projection, diagonals, kLatticeImage);
        // From far away the picture is zoomed, so that the volume fills it as before.
        if (projection == Projection::kPerspective) camera.pixelSize /= std::max(diagonals, 1.0);
        // 20 roundings of the eye's distance in voxels of 0.4 (and of the coordinates themselves).
        const double scale = 2 * grid.boundingRadius() * (diagonals + 1) + 100;
        EXPECT_LT(worstError<double>(camera, grid, 0.5, random), 20 * 0x1p-53 * scale / 0.4);
      }
    }
  }
}

// In float the rounded terms are at most half a diagonal (222 voxels in 256^3), however far the
// eye: each of some ten roundings is at most 2^-24 * 256 = 1.5e-5 and mostly much less. 6e-5 is the
// bound that brick ownership and picture differences elsewhere rely on.
constexpr double kFloatBound = 6e-5;

TEST(SampleLattice, FloatSufficesAtAnyDistance) {
  Random random{11};
  VolumeGrid grid;
  grid.dims = {256, 256, 256};
  grid.origin = {-300, 12, 70};
  for (const double diagonals : {0.5, 1.0, 10.0, 1e3, 1e6}) {
    for (int trial = 0; trial < 5; ++trial) {
      Camera camera =
          test::randomCamera(random, grid, Projection::kPerspective, diagonals, kLatticeImage);
      camera.pixelSize /= std::max(diagonals, 1.0);
      EXPECT_LT(worstError<float>(camera, grid, 0.5, random), kFloatBound) << diagonals;
      camera =
          test::randomCamera(random, grid, Projection::kOrthographic, diagonals, kLatticeImage);
      EXPECT_LT(worstError<float>(camera, grid, 0.5, random), kFloatBound) << diagonals;
    }
  }
}

TEST(SampleLattice, FloatSufficesAtNarrowAndWideAngles) {
  Random random{12};
  VolumeGrid grid;
  grid.dims = {256, 256, 256};
  for (const double fov : {1.0, 30.0, 90.0, 150.0}) {
    for (int trial = 0; trial < 5; ++trial) {
      const Camera camera =
          orbitCamera({random.real(0, 360), random.real(-90, 90), fov}, grid, kLatticeImage);
      EXPECT_LT(worstError<float>(camera, grid, 0.5, random), kFloatBound) << fov;
    }
  }
}

TEST(SampleLattice, ReferenceIsThePlaneNearestTheCentre) {
  Random random{13};
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    for (int trial = 0; trial < 50; ++trial) {
      const VolumeGrid grid = test::makeGrid(random, {60, 80, 50}, Axes::kSheared);
      const Camera camera =
          test::randomCamera(random, grid, projection, random.real(0, 3), kLatticeImage);
      const SampleLattice lattice = makeSampleLattice(camera, grid, 0.7);
      EXPECT_DOUBLE_EQ(lattice.stepWorld, 0.7 * grid.smallestSpacing());
      const glm::dvec3 fromCentre = grid.indexToWorld() * lattice.base;
      // Half a step, and the rounding of distances of a few hundred.
      EXPECT_LE(std::abs(glm::dot(fromCentre, camera.forward)), 0.5 * lattice.stepWorld + 1e-11);
      // Plane -reference is the eye's own: for a perspective eye all its rays meet there.
      const glm::dvec3 eye = grid.indexFromWorld(camera.eyeWorld) - grid.centreIndex();
      const auto j = static_cast<double>(-lattice.reference);
      if (projection == Projection::kPerspective) {
        EXPECT_EQ(lattice.nearPlane, j);
        EXPECT_EQ(lattice.pixelSlope, camera.pixelSize);
        EXPECT_LT(glm::length(latticePosition(lattice, 31.0, -17.0, j) - eye), 1e-10);
      } else {
        EXPECT_EQ(lattice.nearPlane, -std::numeric_limits<double>::infinity());
        EXPECT_EQ(lattice.pixelSlope, 0);
        EXPECT_LT(glm::length(latticePosition(lattice, 0.0, 0.0, j) - eye), 1e-10);
      }
    }
  }
}

TEST(SampleLattice, PositiveFyIsDownInThePicture) {
  VolumeGrid grid;
  grid.dims = {11, 11, 11};
  const SampleLattice lattice = makeSampleLattice(orbitCamera({}, grid, kLatticeImage), grid, 1);
  EXPECT_GT(latticePosition(lattice, 10.0, 0.0, 0.0).x, 0);
  EXPECT_LT(latticePosition(lattice, 0.0, 10.0, 0.0).y, 0);
  EXPECT_LT(latticePosition(lattice, 0.0, 0.0, 1.0).z, latticePosition(lattice, 0.0, 0.0, 0.0).z);
}

TEST(SampleLattice, EyeBeyondCountingIsAnError) {
  VolumeGrid grid;
  grid.dims = {11, 11, 11};
  const Camera camera = lookAtCamera({0, 0, 1e20}, {0, 0, 0}, {0, 1, 0}, 30, 1,
                                     Projection::kPerspective, grid, kLatticeImage);
  EXPECT_THROW(makeSampleLattice(camera, grid, 1), Error);
}

}  // namespace
}  // namespace burin
