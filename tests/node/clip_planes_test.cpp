#include "clip_planes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "support/scenes.hpp"

namespace burin::node {
namespace {

/// Height of a cube's highest point above a plane, by its corners.
double highest(const glm::vec4& plane, const CubeGrid& cubes, const glm::ivec3& cube,
               const glm::dvec3& centre) {
  double height = -1e30;
  for (int k = 0; k < 8; ++k) {
    const glm::ivec3 corner{k & 1, (k >> 1) & 1, k >> 2};
    const glm::dvec3 at{cubes.origin + cubes.cubeCells * (cube + corner)};
    height = std::max(height, glm::dot(glm::dvec3{plane}, at - centre) + double{plane.w});
  }
  return height;
}

TEST(ClearClipped, LeavesOutWhatIsBehindByItsCorners) {
  std::mt19937 random{3};
  std::uniform_real_distribution<double> signedUnit{-1, 1};
  const VolumeGrid grid = test::gridOf({90, 77, 61}, {1, 0.5, 2});
  const CubeGrid cubes{{16, -4, 8}, {13, 20, 11}, 4};
  int cleared = 0;
  for (int i = 0; i < 300; ++i) {
    Scene scene;
    // Every third plane is parallel to an axis or two.
    glm::dvec3 normal{signedUnit(random), signedUnit(random), signedUnit(random)};
    if (i % 3 == 1) normal[i % 9 / 3] = 0;
    if (i % 3 == 2) normal = {i % 9 == 2, i % 9 == 5, i % 9 == 8 ? -1 : 0};
    const double offset = -glm::dot(normal, grid.centreWorld()) + 40 * signedUnit(random);
    scene.clip = {{normal, offset}};
    const auto planes = centredClipPlanes(scene, grid);
    ASSERT_NEAR(glm::length(glm::vec3{planes[0]}), 1, 1e-6);
    std::vector<std::uint8_t> marks(13 * 20 * 11, 1);
    clearClipped(marks, cubes, planes, grid);
    // The margin: a quarter of a voxel and 2^-12 of the radius of 66 voxels.
    constexpr double kMargin = 0.25 + 67 * 0x1p-12;
    std::size_t at = 0;
    for (int z = 0; z < 11; ++z)
      for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 13; ++x, ++at) {
          const double height = highest(planes[0], cubes, {x, y, z}, grid.centreIndex());
          if (height >= -0.25) {
            EXPECT_EQ(marks[at], 1) << i << ": " << height;
          }
          if (height < -kMargin) {
            EXPECT_EQ(marks[at], 0) << i << ": " << height;
          }
          cleared += marks[at] == 0 ? 1 : 0;
        }
  }
  EXPECT_GT(cleared, 300 * 13 * 20 * 11 / 4);
}

TEST(ClearClipped, PlanesAddUp) {
  const VolumeGrid grid = test::gridOf({33, 33, 33});
  Scene scene;
  scene.clip = {{{1, 0, 0}, -8}, {{-1, 0, 0}, 24}};
  std::vector<std::uint8_t> marks(8, 1);
  clearClipped(marks, {{0, 0, 0}, {8, 1, 1}, 4}, centredClipPlanes(scene, grid), grid);
  // Kept: 8 <= x <= 24, and the cubes that touch it, for the margin.
  EXPECT_THAT(marks, testing::ElementsAre(0, 1, 1, 1, 1, 1, 1, 0));
}

TEST(ClearClipped, ABoxIsCutAsItsFaces) {
  const VolumeGrid grid = test::gridOf({33, 33, 33});
  Scene scene;
  scene.clipBox = ClipBox{{8, 4, 4}, {24, 30, 30}};
  std::vector<std::uint8_t> marks(8, 1);
  clearClipped(marks, {{0, 8, 8}, {8, 1, 1}, 4}, centredClipPlanes(scene, grid), grid);
  EXPECT_THAT(marks, testing::ElementsAre(0, 1, 1, 1, 1, 1, 1, 0));
  std::vector<std::uint8_t> outside(8, 1);
  clearClipped(outside, {{0, 8, 31}, {8, 1, 1}, 4}, centredClipPlanes(scene, grid), grid);
  EXPECT_THAT(outside, testing::Each(0));
}

}  // namespace
}  // namespace burin::node
