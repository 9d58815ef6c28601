// The reference's smoothed Laplacian against closed forms.
#include "reference_laplacian.hpp"

#include <gtest/gtest.h>

#include "node/reference_fixture.hpp"

namespace burin::test {
namespace {

/// Of a field over world positions, at an index, over `percentile`.
double laplacianAt(const VolumeGrid& grid, const std::function<double(const glm::dvec3&)>& field,
                   const glm::dvec3& index, double percentile) {
  ArraySource source{grid, [&](glm::ivec3 i) {
                       return static_cast<float>(field(grid.worldFromIndex(glm::dvec3{i})));
                     }};
  const node::ReferenceVolume volume{source};
  return node::ReferenceLaplacian{volume, percentile}.at(index);
}

TEST(ReferenceLaplacian, OfAQuadraticIsItsTraceAtAnySpacing) {
  // Values are rounded to floats of some 1000: 2^-14, of which second differences over spacings of
  // at least 0.5 make up to 12 · 2^-14 / 0.25.
  constexpr double kBound = 12 * 0x1p-14 / 0.25;
  const auto field = [](const glm::dvec3& p) {
    return 3 * p.x * p.x - p.y * p.y + 0.5 * p.z * p.z + 2 * p.x * p.y - 4 * p.y * p.z + p.x;
  };
  VolumeGrid grid = makeGrid({12, 13, 11}, {0.5, 2, 1.25});
  grid.origin = {-3, -13, -6};
  const double percentile = 10;
  EXPECT_NEAR(laplacianAt(grid, field, {5.3, 6, 5.9}, percentile), 5 / percentile, kBound / 10);
  grid.direction = {glm::dvec3{1, 0, 0}, glm::dvec3{0.4, 0.9, 0.1}, glm::dvec3{0.2, -0.3, 0.9}};
  EXPECT_NEAR(laplacianAt(grid, field, {5.3, 6, 5.9}, percentile), 5 / percentile, 2 * kBound / 10);
}

TEST(ReferenceLaplacian, OfAPulseIsTheKernel) {
  // One voxel of 256: binomials 6/16 at the middle, 4/16 beside it, 1/16 two voxels on.
  const VolumeGrid grid = makeGrid({13, 13, 13});
  const auto pulse = [&](const glm::dvec3& p) {
    return glm::distance(p, grid.worldFromIndex(glm::dvec3{6})) < 0.1 ? 256.0 : 0.0;
  };
  const double middle = 6.0 / 16, beside = 4.0 / 16;
  EXPECT_NEAR(laplacianAt(grid, pulse, glm::dvec3{6}, 1000),
              256 * 3 * (2 * beside - 2 * middle) * middle * middle / 1000, 1e-15);
  // Three voxels away along x only the second difference there is not 0: 1/16.
  EXPECT_NEAR(laplacianAt(grid, pulse, {3, 6, 6}, 1000), 256.0 / 16 * middle * middle / 1000,
              1e-15);
  EXPECT_EQ(laplacianAt(grid, pulse, {2, 6, 6}, 1000), 0);
  EXPECT_EQ(laplacianAt(grid, pulse, glm::dvec3{6}, 1e-3), -1);
}

}  // namespace
}  // namespace burin::test
