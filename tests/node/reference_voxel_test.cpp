// Voxel types, and voxels that are not finite.
#include <gtest/gtest.h>

#include <limits>

#include "node/reference_ramp.hpp"

namespace burin::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Camera alongZ(const VolumeGrid& grid, const glm::dvec2& index) {
  const glm::dvec3 target = grid.worldFromIndex({index, grid.centreIndex().z});
  return makeCamera(Projection::kOrthographic, target + glm::dvec3{0, 0, 30}, target, 0.01, {1, 1});
}

Camera oblique(const VolumeGrid& grid) {
  return makeCamera(Projection::kPerspective, grid.centreWorld() + glm::dvec3{6, 8, 12},
                    grid.centreWorld(), 0.05, {12, 12});
}

Scene rampScene(std::vector<StyleSettings> styles = {}) {
  return makeScene(
      {makeLayer(TransferFunction{.points = {{0, {255, 0, 0}, 0}, {60, {0, 255, 90}, 0.6}},
                                  .opacityUnitLength = 1.0},
                 std::move(styles))},
      0.5);
}

TEST(ReferenceVoxels, AllTypesOfTheSameValuesGiveTheSameBits) {
  using node::VoxelType;
  const VolumeGrid grid = makeGrid({7, 6, 5});
  const Scene scene = rampScene({makeStyle("light"), makeStyle("edges")});
  const auto value = [](glm::ivec3 at) { return at.x * at.y + 5 * at.z; };
  ArraySource floats{grid, [&](glm::ivec3 at) { return static_cast<float>(value(at)); }};
  const auto expected = draw(scene, floats, oblique(grid));
  ASSERT_GT(largestOpacity(expected), 0.3);
  const auto expectSame = [&]<typename T>(VoxelType type, T) {
    auto source =
        ArraySource::of<T>(grid, type, [&](glm::ivec3 at) { return static_cast<T>(value(at)); });
    EXPECT_EQ(draw(scene, source, oblique(grid)), expected) << node::voxelTypeName(type);
  };
  expectSame(VoxelType::kU8, std::uint8_t{});
  expectSame(VoxelType::kI16, std::int16_t{});
  expectSame(VoxelType::kU16, std::uint16_t{});
}

TEST(ReferenceVoxels, SignsAndLargeValuesAreKept) {
  const VolumeGrid grid = makeGrid({2, 2, 2});
  // Opacity only on one side of ±30000, so that a wrapped sign changes everything.
  const auto depth = [&](node::BrickSource& source, double from) {
    Scene scene = rampScene();
    scene.layers[0].transferFunction.points = {
        {from - 1, {}, 0}, {from, {}, 0.5}, {from + 1, {}, 0}};
    return opticalDepth(draw(scene, source, alongZ(grid, {0.5, 0.5})).front());
  };
  auto negative = ArraySource::of<std::int16_t>(grid, node::VoxelType::kI16,
                                                [](glm::ivec3) { return std::int16_t{-30000}; });
  auto large = ArraySource::of<std::uint16_t>(grid, node::VoxelType::kU16,
                                              [](glm::ivec3) { return std::uint16_t{50000}; });
  EXPECT_NEAR(depth(negative, -30000), std::log(2.0), 1e-14);
  EXPECT_NEAR(depth(large, 50000), std::log(2.0), 1e-14);
  EXPECT_EQ(depth(large, 50000 - 65536), 0);
}

/// Value 1 everywhere but for a NaN in the middle of 9³ voxels.
ArraySource holed(const VolumeGrid& grid) {
  return {grid, [](glm::ivec3 at) { return at == glm::ivec3{4, 4, 4} ? kNan : 1.0f; }};
}

TEST(ReferenceNan, IsTransparentWhereLessThanHalfIsValid) {
  const VolumeGrid grid = makeGrid({9, 9, 9});
  ArraySource source = holed(grid);
  Scene scene = makeScene({makeLayer(constantTransfer({255, 255, 255}, 0.2))}, 0.25 / 16);
  const auto length = [&](const glm::dvec2& index) {
    return opticalDepth(draw(scene, source, alongZ(grid, index)).front()) / -std::log(0.8);
  };
  // The NaN's weight is (1-|dx|)(1-|dy|)(1-|dz|): above ½ it makes a hole along the ray. Either end
  // of the hole is found to a segment.
  const double tolerance = 2 * 0.25 / 16;
  EXPECT_NEAR(length({4, 4}), 8 - 2 * 0.5, tolerance);
  EXPECT_NEAR(length({4.25, 4}), 8 - 2.0 / 3, tolerance);
  EXPECT_NEAR(length({4, 3.8}), 8 - 2 * 0.375, tolerance);
  EXPECT_NEAR(length({4.5, 4.1}), 8, 1e-12);
  EXPECT_NEAR(length({5, 4}), 8, 1e-12);
}

TEST(ReferenceNan, DoesNotPullItsNeighboursValue) {
  const VolumeGrid grid = makeGrid({9, 9, 9});
  // f = x where valid: beside the NaN the value is the weighted mean of the seven others.
  ArraySource source{grid, [](glm::ivec3 at) {
                       return at == glm::ivec3{4, 4, 4} ? kNan : static_cast<float>(at.x);
                     }};
  Scene scene = rampScene();
  scene.layers[0].transferFunction.points = {{0, {}, 0}, {8, {}, 0.8}};
  const double z = grid.worldFromIndex({0, 0, 4}).z;
  scene.clip = {{.normal = {0, 0, 1}, .offset = -(z - 1e-6)},
                {.normal = {0, 0, -1}, .offset = z + 1e-6}};
  const auto value = [&](const glm::dvec2& index) {
    const double depth = opticalDepth(draw(scene, source, alongZ(grid, index)).front());
    return (1 - std::exp(-depth / 2e-6)) * 10;
  };
  // At (4.6, 4): weights 0.4 on the NaN, 0.6 on x = 5.
  EXPECT_NEAR(value({4.6, 4}), 5, 1e-5);
  // At (4.6, 4.5): 0.2 NaN, 0.2 on (4,5), 0.6 on x = 5.
  EXPECT_NEAR(value({4.6, 4.5}), (0.2 * 4 + 0.6 * 5) / 0.8, 1e-5);
  EXPECT_NEAR(value({6.3, 4.5}), 6.3, 1e-5);
}

TEST(ReferenceNan, LeavesNoGradientBesideIt) {
  const VolumeGrid grid = makeGrid({9, 9, 9});
  ArraySource source{grid, [](glm::ivec3 at) {
                       return at == glm::ivec3{4, 4, 4} ? kNan : static_cast<float>(at.x);
                     }};
  Scene scene =
      rampScene({makeStyle("light", {{"ambient", 0.0}, {"diffuse", 0.0}, {"normal_color", 0.0}})});
  scene.layers[0].transferFunction = constantTransfer({255, 255, 255}, 0.5);
  const double z = grid.worldFromIndex({0, 0, 4}).z;
  scene.clip = {{.normal = {0, 0, 1}, .offset = -(z - 0.25), .hasCap = false},
                {.normal = {0, 0, -1}, .offset = z + 0.25, .hasCap = false}};
  const auto colour = [&](const glm::dvec2& index) {
    const glm::dvec4 pixel = draw(scene, source, alongZ(grid, index)).front();
    EXPECT_GT(pixel.a, 0.2);
    return pixel.g / pixel.a;
  };
  // No ambient and no diffuse light: black wherever there is a direction, else unshaded.
  EXPECT_NEAR(colour({3, 4}), 1, 1e-12);
  EXPECT_NEAR(colour({4, 5}), 1, 1e-12);
  EXPECT_NEAR(colour({2, 4}), 0, 1e-12);
  EXPECT_NEAR(colour({3, 5}), 0, 1e-12);
}

TEST(ReferenceNan, DoesNotCountForTheGradientScale) {
  // Without the NaN's neighbours the largest difference is the ramp's.
  const VolumeGrid grid = makeGrid({9, 9, 9});
  ArraySource source{grid, [](glm::ivec3 at) {
                       if (at == glm::ivec3{4, 4, 4}) return kNan;
                       return static_cast<float>(at.x) + (at == glm::ivec3{5, 4, 4} ? 0.25f : 0.0f);
                     }};
  Scene scene = rampScene({makeStyle("gradient", {{"magnitude", std::string{"maximum"}}}),
                           makeStyle("surface", {{"opacity", Curve{{{0, 0}, {1, 1}}}}})});
  scene.layers[0].transferFunction = constantTransfer({255, 255, 255}, 0.5);
  const double z = grid.worldFromIndex({0, 0, 2}).z;
  scene.clip = {{.normal = {0, 0, 1}, .offset = -(z - 0.25)},
                {.normal = {0, 0, -1}, .offset = z + 0.25}};
  const double depth = opticalDepth(draw(scene, source, alongZ(grid, {2, 2})).front());
  // The raised voxel's neighbour at x = 6 has (7 - 5.25)/2 along x; those beside it in y and z have
  // length |(1, 1/8, 0)|, the largest.
  EXPECT_NEAR(depth, 0.5 * std::log(2.0) / std::sqrt(1 + 1.0 / 64), 1e-12);
}

TEST(ReferenceNan, AVolumeOfNothingElseIsTransparent) {
  const VolumeGrid grid = makeGrid({5, 5, 5});
  ArraySource source{grid, [](glm::ivec3) { return kNan; }};
  Scene scene = rampScene({makeStyle("light"), makeStyle("edges")});
  scene.layers[0].transferFunction = constantTransfer({255, 255, 255}, 0.5);
  EXPECT_EQ(largestOpacity(draw(scene, source, oblique(grid))), 0);
}

TEST(ReferenceInfinity, IsTheEndOfTheFiniteRange) {
  const VolumeGrid grid = makeGrid({7, 6, 5});
  const Scene scene = rampScene({makeStyle("light"), makeStyle("surface")});
  const auto field = [](float high, float low) {
    return [=](glm::ivec3 at) {
      if (at == glm::ivec3{3, 3, 2}) return high;
      if (at == glm::ivec3{4, 2, 3}) return low;
      return static_cast<float>(2 + at.x * at.y + 5 * at.z);  // 2 … 52
    };
  };
  ArraySource infinite{grid, field(kInfinity, -kInfinity)};
  ArraySource finite{grid, field(52, 2)};
  const auto pixels = draw(scene, infinite, oblique(grid));
  EXPECT_EQ(pixels, draw(scene, finite, oblique(grid)));
  ArraySource neither{grid, field(kNan, kNan)};
  EXPECT_GT(largestDifference(pixels, draw(scene, neither, oblique(grid))), 1e-3);
}

TEST(ReferenceInfinity, AVolumeOfNothingElseIsZero) {
  const VolumeGrid grid = makeGrid({5, 5, 5});
  ArraySource source{grid, [](glm::ivec3 at) { return at.x % 2 == 0 ? kInfinity : -kInfinity; }};
  Scene scene = rampScene();
  scene.layers[0].transferFunction.points = {{-1, {}, 0}, {0, {}, 0.5}, {1, {}, 0}};
  EXPECT_NEAR(opticalDepth(draw(scene, source, alongZ(grid, {2, 2})).front()), 4 * std::log(2.0),
              1e-14);
}

}  // namespace
}  // namespace burin::test
