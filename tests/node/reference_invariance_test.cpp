// What must not change the picture: world scale, sampling of the same field, rigid motion, the
// order of layers, threads; and what early ray termination may change.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "node/reference_fixture.hpp"

namespace burin::test {
namespace {

float smoothField(glm::ivec3 at) {
  const glm::dvec3 p = glm::dvec3{at} - glm::dvec3{5, 4.5, 6};
  return static_cast<float>(std::exp(-glm::dot(p, p) / 20));
}

/// Light, tone, edges and specular from world-space lights, so that a moved scene is the same
/// scene.
Scene styledScene(double unitLength) {
  Layer layer =
      makeLayer(TransferFunction{.points = {{0.05, {200, 90, 40}, 0}, {0.9, {255, 240, 200}, 0.7}},
                                 .opacityUnitLength = unitLength},
                {makeStyle("surface"), makeStyle("light"), makeStyle("tone"), makeStyle("edges"),
                 makeStyle("specular")});
  Scene scene = makeScene({layer}, 0.5);
  scene.lights = {{.direction = {1, 2, 3}, .eyeSpace = false, .colour = {255, 230, 210}},
                  {.direction = {-2, 1, 0}, .eyeSpace = false, .intensity = 0.4}};
  return scene;
}

Camera lookFrom(const VolumeGrid& grid, Projection projection) {
  return makeCamera(projection, grid.centreWorld() + glm::dvec3{8, 11, 25}, grid.centreWorld(),
                    projection == Projection::kPerspective ? 0.03 : 0.8, {20, 18});
}

class ReferenceInvariance : public testing::TestWithParam<Projection> {};

TEST_P(ReferenceInvariance, WorldScale) {
  VolumeGrid grid = makeGrid({11, 10, 13}, {1, 1.2, 0.9});
  Scene scene = styledScene(1.5);
  Camera camera = lookFrom(grid, GetParam());
  scene.clip = {{.normal = {1, 1, 0}, .offset = 2 - glm::dot({1, 1, 0}, grid.centreWorld())}};
  ArraySource source{grid, smoothField};
  const auto before = draw(scene, source, camera);
  ASSERT_GT(largestOpacity(before), 0.5);

  constexpr double kScale = 1000;
  grid.origin *= kScale;
  grid.spacing *= kScale;
  camera.eyeWorld *= kScale;
  if (GetParam() == Projection::kOrthographic) camera.pixelSize *= kScale;
  *scene.layers[0].transferFunction.opacityUnitLength *= kScale;
  scene.clip[0].offset *= kScale;
  ArraySource scaled{grid, smoothField};
  // Sample positions differ by roundings (1e-14 of the world's size); nothing is steeper than 100.
  EXPECT_LT(largestDifference(draw(scene, scaled, camera), before), 1e-11);
}

/// Index axes neither orthogonal nor of one length: a sheared grid, then everything turned.
TEST_P(ReferenceInvariance, RigidMotionOfAShearedGrid) {
  VolumeGrid grid = makeGrid({11, 10, 13}, {1, 1.2, 0.9});
  grid.direction = {glm::dvec3{1, 0, 0}, glm::dvec3{0.3, 0.95, 0}, glm::dvec3{-0.1, 0.2, 0.97}};
  Scene scene = styledScene(1);
  Camera camera = lookFrom(grid, GetParam());
  scene.clip = {{.normal = {1, 1, 0}, .offset = 2 - glm::dot({1, 1, 0}, grid.centreWorld())}};
  ArraySource source{grid, smoothField};
  const auto before = draw(scene, source, camera);
  ASSERT_GT(largestOpacity(before), 0.5);

  const glm::dmat3 turn{glm::rotate(glm::dmat4{1}, 1.1, glm::normalize(glm::dvec3{1, -2, 0.5}))};
  const glm::dvec3 shift{7, -9, 4};
  grid.direction = turn * grid.direction;
  grid.origin = turn * grid.origin + shift;
  camera.eyeWorld = turn * camera.eyeWorld + shift;
  for (glm::dvec3* axis : {&camera.right, &camera.up, &camera.forward}) *axis = turn * *axis;
  for (Light& light : scene.lights) light.direction = turn * light.direction;
  for (ClipPlane& plane : scene.clip) {
    plane.normal = turn * plane.normal;
    plane.offset -= glm::dot(plane.normal, shift);
  }
  ArraySource turned{grid, smoothField};
  EXPECT_LT(largestDifference(draw(scene, turned, camera), before), 1e-11);
}

/// The same linear field on voxels twice as far apart along z. Clipped to where all six taps of the
/// gradient lie inside both grids, because at the border the difference is one-sided and halved.
TEST_P(ReferenceInvariance, SamplingOfALinearField) {
  const auto field = [](const glm::dvec3& p) {
    return static_cast<float>(p.x / 16 + p.y / 32 + p.z / 64);  // exact in float
  };
  const VolumeGrid fine = makeGrid({17, 17, 17});
  const VolumeGrid coarse = makeGrid({17, 17, 9}, {1, 1, 2});
  Scene scene = styledScene(1);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 normal{0};
    normal[axis] = 1;
    scene.clip.push_back({.normal = normal, .offset = -(fine.origin[axis] + 2)});
    scene.clip.push_back({.normal = -normal, .offset = fine.origin[axis] + 14});
  }
  ArraySource fineSource{fine, [&](glm::ivec3 at) { return field(at); }};
  ArraySource coarseSource{coarse, [&](glm::ivec3 at) { return field({at.x, at.y, 2 * at.z}); }};
  const Camera camera = lookFrom(fine, GetParam());
  const auto pixels = draw(scene, fineSource, camera, 0.1);
  ASSERT_GT(largestOpacity(pixels), 0.5);
  EXPECT_LT(largestDifference(draw(scene, coarseSource, camera, 0.1), pixels), 1e-11);
}

INSTANTIATE_TEST_SUITE_P(BothProjections, ReferenceInvariance,
                         testing::Values(Projection::kPerspective, Projection::kOrthographic));

TEST(ReferenceLayers, OrderDoesNotMatter) {
  const VolumeGrid grid = makeGrid({11, 10, 13});
  ArraySource source{grid, smoothField};
  Scene scene = styledScene(1);
  scene.layers.push_back(makeLayer(
      TransferFunction{.points = {{0.2, {0, 80, 255}, 0}, {0.3, {0, 80, 255}, 0.4}, {0.4, {}, 0}},
                       .opacityUnitLength = 2.0},
      {makeStyle("light")}));
  const Camera camera = lookFrom(grid, Projection::kPerspective);
  const auto both = draw(scene, source, camera);
  std::swap(scene.layers[0], scene.layers[1]);
  EXPECT_LT(largestDifference(draw(scene, source, camera), both), 1e-14);
  scene.layers.pop_back();
  EXPECT_GT(largestDifference(draw(scene, source, camera), both), 0.1);
}

TEST(ReferenceLayers, ExtinctionsAddAndColoursMixByExtinction) {
  const VolumeGrid grid = makeGrid({5, 5, 5});
  ArraySource source = homogeneous(grid);
  const Scene scene = makeScene({makeLayer(constantTransfer({255, 0, 0}, 0.1)),
                                 makeLayer(constantTransfer({0, 0, 255}, 0.3))},
                                0.5);
  const Camera camera =
      makeCamera(Projection::kOrthographic, grid.centreWorld() + glm::dvec3{0, 0, 9},
                 grid.centreWorld(), 0.1, {1, 1});
  const glm::dvec4 pixel = draw(scene, source, camera).front();
  const double red = -std::log(0.9);
  const double blue = -std::log(0.7);
  EXPECT_NEAR(pixel.a, 1 - std::pow(0.9 * 0.7, 4), 1e-14);
  EXPECT_NEAR(pixel.r, pixel.a * red / (red + blue), 1e-14);
  EXPECT_NEAR(pixel.g, 0, 1e-14);
  EXPECT_NEAR(pixel.b, pixel.a * blue / (red + blue), 1e-14);
}

TEST(ReferenceTermination, ErrorIsAtMostItsThreshold) {
  const VolumeGrid grid = makeGrid({11, 10, 13});
  ArraySource source{grid, smoothField};
  Scene scene = styledScene(0.5);
  // Colours stay within 1, so what is left out behind transmittance T is at most T.
  scene.layers[0].styles = {makeStyle("tone")};
  const Camera camera = lookFrom(grid, Projection::kPerspective);
  const auto full = draw(scene, source, camera);
  for (const double termination : {0.3, 0.05, 0.002}) {
    scene.quality.termination = termination;
    const auto cut = draw(scene, source, camera);
    const double error = largestDifference(cut, full);
    EXPECT_LE(error, termination);
    EXPECT_GT(error, 0) << "nothing was terminated";
    for (std::size_t i = 0; i < cut.size(); ++i) EXPECT_LE(cut[i].a, full[i].a);
  }
}

TEST(ReferenceRows, PiecesAndThreadsGiveTheSameBits) {
  const VolumeGrid grid = makeGrid({11, 10, 13});
  ArraySource source{grid, smoothField};
  const Camera camera = lookFrom(grid, Projection::kPerspective);
  const node::ReferenceRenderer renderer{styledScene(1), source};
  const int height = camera.image.height;
  const auto whole = renderer.render(camera, 0, height, 1);
  EXPECT_EQ(renderer.render(camera, 0, height, 5), whole);
  auto pieces = renderer.render(camera, 0, 7, 2);
  for (const glm::dvec4& pixel : renderer.render(camera, 7, height, 3)) pieces.push_back(pixel);
  EXPECT_EQ(pieces, whole);
  EXPECT_TRUE(renderer.render(camera, 4, 4, 2).empty());
}

}  // namespace
}  // namespace burin::test
