// Homogeneous volumes: opacity 1 - exp(-σL) in closed form, at any step, because segments end where
// the volume ends.
#include <gtest/gtest.h>

#include <algorithm>

#include "node/reference_fixture.hpp"

namespace burin::test {
namespace {

constexpr double kOpacity = 0.2;
const double kExtinction = -std::log(1 - kOpacity);
const Colour kColour{255, 128, 0};

// A few hundred roundings of numbers below 1 (u = 1.1e-16), and chords of length 20 at positions
// below 100: 1e-12 is ten times what they add up to.
constexpr double kRounding = 1e-12;

/// World length of the ray inside an upright box: the distance between the outermost of the points
/// where it pierces a face (and the eye, if that is inside and the ray starts there).
double chord(const Box& box, const glm::dvec3& origin, const glm::dvec3& direction,
             bool startsHere) {
  const auto inside = [&](const glm::dvec3& p, int except) {
    for (int axis = 0; axis < 3; ++axis)
      if (axis != except && (p[axis] < box.lo[axis] || p[axis] > box.hi[axis])) return false;
    return true;
  };
  std::vector<double> hits;
  if (startsHere && inside(origin, -1)) hits.push_back(0);
  for (int axis = 0; axis < 3; ++axis)
    for (const double face : {box.lo[axis], box.hi[axis]}) {
      if (direction[axis] == 0) continue;
      const double t = (face - origin[axis]) / direction[axis];
      if (inside(origin + t * direction, axis) && (t >= 0 || !startsHere)) hits.push_back(t);
    }
  if (hits.empty()) return 0;
  const auto [first, last] = std::minmax_element(hits.begin(), hits.end());
  return (*last - *first) * glm::length(direction);
}

Box worldBox(const VolumeGrid& grid) {
  const Box index = grid.boxIndex();
  return {grid.origin + grid.spacing * index.lo, grid.origin + grid.spacing * index.hi};
}

Scene slabScene(double stepVoxels) {
  return makeScene({makeLayer(constantTransfer(kColour, kOpacity))}, stepVoxels);
}

/// Every pixel against the closed form; the volume is upright. Returns how many rays met it.
int expectClosedForm(const Scene& scene, const VolumeGrid& grid, const Camera& camera,
                     double tolerance) {
  ArraySource source = homogeneous(grid);
  const auto pixels = draw(scene, source, camera);
  const bool perspective = camera.projection == Projection::kPerspective;
  const ImageSize image = camera.image;
  int met = 0;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column) {
      const glm::dvec3 offset =
          camera.pixelSize * ((column + 0.5 - 0.5 * image.width) * camera.right +
                              (0.5 * image.height - row - 0.5) * camera.up);
      const double length =
          perspective ? chord(worldBox(grid), camera.eyeWorld, camera.forward + offset, true)
                      : chord(worldBox(grid), camera.eyeWorld + offset, camera.forward, false);
      const double alpha = 1 - std::exp(-kExtinction * length);
      const glm::dvec4 pixel = pixels[static_cast<std::size_t>(row * image.width + column)];
      EXPECT_NEAR(pixel.a, alpha, tolerance) << "column " << column << ", row " << row;
      const glm::dvec3 difference = glm::abs(rgb(pixel) - alpha * kColour.linear());
      EXPECT_LE(std::max({difference.r, difference.g, difference.b}), tolerance);
      met += length > 0 ? 1 : 0;
    }
  return met;
}

class ReferenceSlab : public testing::TestWithParam<double> {};

TEST_P(ReferenceSlab, PerspectiveFromOutside) {
  const VolumeGrid grid = makeGrid({9, 7, 12}, {1, 1.5, 0.8});
  const Camera camera =
      makeCamera(Projection::kPerspective, grid.centreWorld() + glm::dvec3{9, 14, 21},
                 grid.centreWorld(), 0.045, {16, 14});
  EXPECT_GT(expectClosedForm(slabScene(GetParam()), grid, camera, kRounding), 50);
}

TEST_P(ReferenceSlab, PerspectiveFromInside) {
  const VolumeGrid grid = makeGrid({9, 7, 12}, {1, 1.5, 0.8});
  const Camera camera =
      makeCamera(Projection::kPerspective, grid.centreWorld() + glm::dvec3{1, 0.5, 2},
                 grid.centreWorld(), 0.2, {16, 14});
  EXPECT_EQ(expectClosedForm(slabScene(GetParam()), grid, camera, kRounding), 16 * 14);
}

TEST_P(ReferenceSlab, OrthographicHasNoNearSide) {
  const VolumeGrid grid = makeGrid({9, 7, 12}, {1, 1.5, 0.8});
  const glm::dvec3 towards{-3, -4, -5};
  for (const double back : {-2.0, 0.1, 3.0}) {
    const Camera camera = makeCamera(Projection::kOrthographic, grid.centreWorld() - back * towards,
                                     grid.centreWorld() - (back - 1) * towards, 0.9, {16, 14});
    EXPECT_GT(expectClosedForm(slabScene(GetParam()), grid, camera, kRounding), 50);
  }
}

TEST_P(ReferenceSlab, OrthographicAlongAnAxis) {
  const VolumeGrid grid = makeGrid({9, 7, 12});
  const Camera camera =
      makeCamera(Projection::kOrthographic, grid.centreWorld() + glm::dvec3{0, 0, 30},
                 grid.centreWorld(), 0.73, {16, 14});
  EXPECT_GT(expectClosedForm(slabScene(GetParam()), grid, camera, kRounding), 50);
}

INSTANTIATE_TEST_SUITE_P(AnyStep, ReferenceSlab, testing::Values(0.25, 1.0, 3.7, 1000.0));

TEST(ReferenceSlabCamera, ThousandDiagonalsAway) {
  const VolumeGrid grid = makeGrid({9, 7, 12});
  const double distance = 2000 * grid.boundingRadius();
  const Camera camera = makeCamera(
      Projection::kPerspective, grid.centreWorld() + distance * glm::normalize(glm::dvec3{1, 2, 3}),
      grid.centreWorld(), 1.0 / distance, {16, 14});
  // Depths are about 2e4, rounded to 2e4 * 2^-53 = 2e-12 at either end of the chord.
  EXPECT_GT(expectClosedForm(slabScene(0.5), grid, camera, 1e-11), 50);
}

TEST(ReferenceSlabCamera, BehindTheVolumeSeesNothing) {
  const VolumeGrid grid = makeGrid({9, 7, 12});
  const glm::dvec3 eye = grid.centreWorld() + glm::dvec3{0, 0, 30};
  ArraySource source = homogeneous(grid);
  const Camera camera =
      makeCamera(Projection::kPerspective, eye, eye + glm::dvec3{0, 0, 1}, 0.05, {8, 8});
  EXPECT_EQ(largestOpacity(draw(slabScene(0.5), source, camera)), 0);
}

/// Optical depth in the picture's middle of a volume seen along z.
double depthAlongZ(const Scene& scene, const VolumeGrid& grid) {
  ArraySource source = homogeneous(grid);
  const Camera camera =
      makeCamera(Projection::kOrthographic, grid.centreWorld() + glm::dvec3{0.1, 0.1, 30},
                 grid.centreWorld() + glm::dvec3{0.1, 0.1, 0}, 0.1, {1, 1});
  return opticalDepth(draw(scene, source, camera).front());
}

TEST(ReferenceClip, PlaneThroughTheCentreHalves) {
  const VolumeGrid grid = makeGrid({9, 9, 9});
  Scene scene = slabScene(0.7);
  ASSERT_NEAR(depthAlongZ(scene, grid), 8 * kExtinction, kRounding);
  for (const double sign : {1.0, -1.0}) {
    scene.clip = {{.normal = {0, 0, 5 * sign}, .offset = -5 * sign * grid.centreWorld().z}};
    EXPECT_NEAR(depthAlongZ(scene, grid), 4 * kExtinction, kRounding);
  }
}

TEST(ReferenceClip, PlanesKeepTheirCommonPart) {
  const VolumeGrid grid = makeGrid({9, 9, 9});
  const double z = grid.centreWorld().z;
  const double x = grid.centreWorld().x + 0.1;
  Scene scene = slabScene(0.7);
  scene.clip = {{.normal = {0, 0, 1}, .offset = -(z - 1.25)},
                {.normal = {0, 0, -1}, .offset = z + 2}};
  EXPECT_NEAR(depthAlongZ(scene, grid), 3.25 * kExtinction, kRounding);
  // Keeps x + z >= x0 + z0 + 1/2: from z0 + 1/2 on along this ray.
  scene.clip.push_back({.normal = {1, 0, 1}, .offset = -(x + z + 0.5)});
  EXPECT_NEAR(depthAlongZ(scene, grid), 1.5 * kExtinction, kRounding);
  // A plane along the ray keeps or removes all of it.
  scene.clip.push_back({.normal = {1, 0, 0}, .offset = -(x - 1)});
  EXPECT_NEAR(depthAlongZ(scene, grid), 1.5 * kExtinction, kRounding);
  scene.clip.push_back({.normal = {1, 0, 0}, .offset = -(x + 1)});
  EXPECT_EQ(depthAlongZ(scene, grid), 0);
}

TEST(ReferenceThinVolume, AxisOfOneVoxelIsOneSpacingThick) {
  for (const double step : {0.3, 1.0, 50.0}) {
    EXPECT_NEAR(depthAlongZ(slabScene(step), makeGrid({5, 5, 1}, {1, 1, 3})), 3 * kExtinction,
                kRounding);
    EXPECT_NEAR(depthAlongZ(slabScene(step), makeGrid({1, 1, 1}, {1, 2, 0.5})), 0.5 * kExtinction,
                kRounding);
    EXPECT_NEAR(depthAlongZ(slabScene(step), makeGrid({1, 5, 4}, {1, 1, 1})), 3 * kExtinction,
                kRounding);
  }
}

TEST(ReferenceThinVolume, ValueIsConstantAcrossIt) {
  const VolumeGrid grid = makeGrid({5, 5, 1}, {1, 1, 3});
  ArraySource source{grid, [](glm::ivec3 at) { return static_cast<float>(at.x); }};
  Scene scene = slabScene(0.5);
  scene.layers[0].transferFunction.points = {{0, kColour, 0}, {4, kColour, 0.8}};
  const Camera camera =
      makeCamera(Projection::kOrthographic, grid.centreWorld() + glm::dvec3{0, 0, 9},
                 grid.centreWorld(), 1, {4, 1});
  const auto pixels = draw(scene, source, camera);
  // Column c looks along -z with x to the right, at index x = c + 1/2: opacity 0.2 x.
  for (int column = 0; column < 4; ++column)
    EXPECT_NEAR(opticalDepth(pixels[static_cast<std::size_t>(column)]),
                -3 * std::log(1 - 0.2 * (column + 0.5)), kRounding);
}

}  // namespace
}  // namespace burin::test
