#include "burin/common/geometry.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/views.hpp"

namespace burin {
namespace {

using test::Axes;
using test::Random;

// A round trip multiplies by a matrix and by its inverse (condition below 10 here) and adds an
// origin of up to 50 to coordinates of up to 250: a few dozen roundings of 1.1e-16 * 300 * 10.
constexpr double kRoundTrip = 1e-11;

TEST(IndexBox, CountsAndIntersects) {
  const IndexBox a{{0, 0, 0}, {4, 5, 6}};
  const IndexBox b{{2, -1, 3}, {9, 2, 5}};
  EXPECT_EQ(a.count(), 120u);
  EXPECT_EQ(intersection(a, b), (IndexBox{{2, 0, 3}, {4, 2, 5}}));
  EXPECT_TRUE(a.contains(intersection(a, b)));
  EXPECT_FALSE(a.contains(b));
  const IndexBox apart = intersection(a, {{4, 0, 0}, {5, 5, 6}});
  EXPECT_TRUE(apart.empty());
  EXPECT_EQ(apart.count(), 0u);
  EXPECT_EQ((IndexBox{{0, 0, 0}, {2048, 2048, 2048}}.count()), std::size_t{1} << 33);
}

TEST(VolumeGrid, IndexAndWorldAreInverse) {
  Random random{1};
  for (const Axes axes : {Axes::kAligned, Axes::kRotated, Axes::kReflected, Axes::kSheared}) {
    for (int trial = 0; trial < 20; ++trial) {
      const VolumeGrid grid = test::makeGrid(random, {97, 60, 41}, axes);
      const glm::dvec3 index = random.vector(-10, 100);
      const glm::dvec3 back = grid.indexFromWorld(grid.worldFromIndex(index));
      EXPECT_LT(glm::length(back - index), kRoundTrip);
      const glm::dvec3 vector = random.direction();
      EXPECT_LT(glm::length(grid.worldToIndex() * (grid.indexToWorld() * vector) - vector),
                kRoundTrip);
    }
  }
}

TEST(VolumeGrid, VoxelIsAPointSample) {
  VolumeGrid grid;
  grid.dims = {3, 4, 5};
  grid.origin = {10, 20, 30};
  grid.spacing = {0.5, 2, 3};
  grid.direction = {{0, 1, 0}, {-1, 0, 0}, {0, 0, -1}};  // turned about z, and reflected
  EXPECT_EQ(grid.worldFromIndex({2, 3, 4}), (glm::dvec3{10 - 3 * 2, 20 + 2 * 0.5, 30 - 4 * 3}));
  EXPECT_EQ(grid.centreIndex(), (glm::dvec3{1, 1.5, 2}));
  EXPECT_EQ(grid.centreWorld(), (glm::dvec3{7, 20.5, 24}));
  EXPECT_EQ(grid.voxelCount(), 60u);
  EXPECT_EQ(grid.cells(), (glm::ivec3{2, 3, 4}));
  EXPECT_EQ(grid.smallestSpacing(), 0.5);
  // The filled box is 1 x 6 x 12 world units.
  EXPECT_DOUBLE_EQ(grid.boundingRadius(), 0.5 * std::sqrt(1.0 + 36 + 144));
}

TEST(VolumeGrid, AxisOfOneVoxelIsOneSpacingThick) {
  VolumeGrid grid;
  grid.dims = {1, 9, 1};
  grid.spacing = {2, 1, 4};
  grid.origin = {5, 0, 0};
  EXPECT_EQ(grid.cells(), (glm::ivec3{1, 8, 1}));
  EXPECT_EQ(grid.boxIndex().lo, (glm::dvec3{-0.5, 0, -0.5}));
  EXPECT_EQ(grid.boxIndex().hi, (glm::dvec3{0.5, 8, 0.5}));
  EXPECT_EQ(grid.centreWorld(), (glm::dvec3{5, 4, 0}));
  EXPECT_DOUBLE_EQ(grid.boundingRadius(), 0.5 * std::sqrt(4.0 + 64 + 16));
  const Box part = grid.cellBoxIndex({{0, 2, 0}, {1, 5, 1}});
  EXPECT_EQ(part.lo, (glm::dvec3{-0.5, 2, -0.5}));
  EXPECT_EQ(part.hi, (glm::dvec3{0.5, 5, 0.5}));
}

TEST(VolumeGrid, BoundingRadiusIsTheFarthestCorner) {
  Random random{2};
  for (int trial = 0; trial < 20; ++trial) {
    const VolumeGrid grid = test::makeGrid(random, {30, 20, 40}, Axes::kSheared);
    double farthest = 0;
    for (const int x : {0, 29}) {
      for (const int y : {0, 19}) {
        for (const int z : {0, 39}) {
          const glm::dvec3 corner = grid.worldFromIndex(glm::dvec3{glm::ivec3{x, y, z}});
          farthest = std::max(farthest, glm::length(corner - grid.centreWorld()));
        }
      }
    }
    EXPECT_NEAR(grid.boundingRadius(), farthest, kRoundTrip);
  }
}

TEST(VolumeGrid, TinyAndHugeSpacingInvert) {
  for (const double spacing : {1e-120, 1e-20, 1e20, 1e120}) {
    VolumeGrid grid;
    grid.dims = {10, 10, 10};
    grid.spacing = glm::dvec3{spacing};
    const glm::dvec3 index = grid.indexFromWorld(grid.worldFromIndex({3, 4, 5}));
    EXPECT_LT(glm::length(index - glm::dvec3{3, 4, 5}), 1e-14) << spacing;  // four roundings
  }
}

}  // namespace
}  // namespace burin
