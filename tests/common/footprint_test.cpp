#include "burin/common/footprint.hpp"

#include <gtest/gtest.h>

#include "common/views.hpp"

namespace burin {
namespace {

using test::Axes;
using test::Random;

constexpr ImageSize kImage{40, 28};

IndexBox randomBox(Random& random, glm::ivec3 cells) {
  IndexBox box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = random.integer(0, cells[axis] - 1);
    box.hi[axis] = random.integer(box.lo[axis] + 1, cells[axis]);
  }
  return box;
}

TEST(Footprint, ContainsEveryPixelThatMeetsTheBox) {
  Random random{40};
  int hits = 0;
  for (const Axes axes : {Axes::kAligned, Axes::kReflected, Axes::kSheared}) {
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      for (const glm::ivec3& dims : {glm::ivec3{20, 27, 14}, glm::ivec3{1, 12, 9}}) {
        for (int trial = 0; trial < 60; ++trial) {
          const VolumeGrid grid = test::makeGrid(random, dims, axes);
          const IndexBox cells = randomBox(random, grid.cells());
          const Camera camera =
              test::randomCamera(random, grid, projection, random.real(1e-3, 2), kImage);
          const PixelRect rect = footprint(camera, grid, cells);
          EXPECT_EQ(intersection(rect, {0, 0, kImage.width, kImage.height}), rect);
          for (int row = 0; row < kImage.height; ++row) {
            for (int column = 0; column < kImage.width; ++column) {
              const test::Ray ray = test::rayWorld(camera, column + 0.5, row + 0.5);
              if (!test::depthsInside(grid, cells, camera, ray)) continue;
              ++hits;
              ASSERT_TRUE(column >= rect.x0 && column < rect.x1 && row >= rect.y0 && row < rect.y1)
                  << "pixel " << column << ' ' << row;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(hits, 10000);
}

TEST(Footprint, OfASlabContainsEveryPixelThatMeetsTheBoxThere) {
  Random random{41};
  int hits = 0;
  int smaller = 0;
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    for (int trial = 0; trial < 250; ++trial) {
      const VolumeGrid grid = test::makeGrid(random, {20, 27, 14}, Axes::kSheared);
      const IndexBox cells = randomBox(random, grid.cells());
      const Camera camera =
          test::randomCamera(random, grid, projection, random.real(0.3, 2), kImage);
      const DepthRange whole = depthRange(camera, grid, cells);
      const double from = random.real(whole.nearest, whole.farthest);
      const DepthRange slab{from, from + 0.2 * (whole.farthest - whole.nearest)};
      const PixelRect rect = footprint(camera, grid, cells, slab);
      smaller += rect.pixels() < footprint(camera, grid, cells).pixels() ? 1 : 0;
      for (int row = 0; row < kImage.height; ++row)
        for (int column = 0; column < kImage.width; ++column) {
          const test::Ray ray = test::rayWorld(camera, column + 0.5, row + 0.5);
          const auto inside = test::depthsInside(grid, cells, camera, ray);
          if (!inside || inside->begin > slab.farthest || inside->end < slab.nearest) continue;
          ++hits;
          ASSERT_TRUE(column >= rect.x0 && column < rect.x1 && row >= rect.y0 && row < rect.y1)
              << "pixel " << column << ' ' << row;
        }
    }
  }
  EXPECT_GT(hits, 5000);
  EXPECT_GT(smaller, 150);
}

TEST(Footprint, OfASlabBeforeOrBehindTheBoxIsEmpty) {
  VolumeGrid grid;
  grid.dims = {21, 21, 21};
  const Camera camera = orbitCamera({0, 0, 30, 1, 'y', Projection::kPerspective}, grid, kImage);
  const IndexBox cells{{0, 0, 0}, {20, 20, 20}};
  const DepthRange whole = depthRange(camera, grid, cells);
  EXPECT_NEAR(whole.farthest - whole.nearest, 20, 0.01);
  EXPECT_TRUE(footprint(camera, grid, cells, {whole.nearest - 2, whole.nearest - 1}).empty());
  EXPECT_TRUE(footprint(camera, grid, cells, {whole.farthest + 1, whole.farthest + 2}).empty());
}

TEST(Footprint, IsTightInAParallelFrontView) {
  VolumeGrid grid;
  grid.dims = {21, 21, 21};
  Camera camera = orbitCamera({0, 0, 30, 1, 'y', Projection::kOrthographic}, grid, {100, 100});
  camera.pixelSize = 0.4;  // cells [4, 8) x [10, 15): columns 50 - 15 … 50 - 5, rows 37.5 … 50
  const PixelRect rect = footprint(camera, grid, {{4, 10, 0}, {8, 15, 20}});
  EXPECT_LE(std::abs(rect.x0 - 35), 2);
  EXPECT_LE(std::abs(rect.x1 - 45), 2);
  EXPECT_LE(std::abs(rect.y0 - 37), 2);
  EXPECT_LE(std::abs(rect.y1 - 50), 2);
}

TEST(Footprint, PerspectiveBehindAndBeside) {
  VolumeGrid grid;
  grid.dims = {21, 21, 21};
  const auto view = [&](double z, double targetZ) {
    return lookAtCamera({10, 10, z}, {10, 10, targetZ}, {0, 1, 0}, 40, 1, Projection::kPerspective,
                        grid, kImage);
  };
  const IndexBox all{{0, 0, 0}, {20, 20, 20}};
  const PixelRect whole{0, 0, kImage.width, kImage.height};
  EXPECT_EQ(footprint(view(10, 0), grid, all), whole);
  EXPECT_EQ(footprint(view(20, 0), grid, all), whole);  // eye on the face: depth 0
  EXPECT_TRUE(footprint(view(30, 40), grid, all).empty());
  EXPECT_EQ(footprint(view(10, 0), grid, {{0, 0, 12}, {20, 20, 20}}), PixelRect{});
  EXPECT_TRUE(footprint(view(30, 0), grid, {}).empty());
}

TEST(Footprint, OutsideTheImageIsEmpty) {
  VolumeGrid grid;
  grid.dims = {21, 21, 21};
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    const Camera camera =
        lookAtCamera({500, 10, 60}, {500, 10, 0}, {0, 1, 0}, 20, 1, projection, grid, kImage);
    EXPECT_EQ(footprint(camera, grid, {{0, 0, 0}, {20, 20, 20}}), PixelRect{});
  }
}

}  // namespace
}  // namespace burin
