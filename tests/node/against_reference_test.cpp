// The fused ray-cast program against the double-precision reference and closed forms.

#include "support/against_reference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/scenes.hpp"

namespace burin::test {
namespace {

class AgainstReference : public testing::TestWithParam<std::string> {};

TEST_P(AgainstReference, EveryStyleInEveryView) {
  ArraySource source = smoothVolume(gridOf({40, 33, 36}, {1, 1.2, 0.8}));
  const VolumeGrid& grid = source.info().grid;
  Scene scene = resolved(sceneWithStyle(GetParam()), source);
  struct {
    const char* name;
    CameraChoice camera;
  } const views[] = {
      {"perspective", {.azimuthDeg = 30, .elevationDeg = 20}},
      {"parallel",
       {.azimuthDeg = 200, .elevationDeg = -35, .projection = Projection::kOrthographic}},
      {"fov 1", {.azimuthDeg = 70, .elevationDeg = 10, .verticalFovDeg = 1}},
      {"fov 90", {.azimuthDeg = -20, .elevationDeg = 60, .verticalFovDeg = 90}},
      {"1000 diagonals away",  // fov 2 asin(1/2000), zoomed to fill the picture as always
       {.azimuthDeg = 130, .elevationDeg = 5, .verticalFovDeg = 0.0572958}},
      {"pole", {.azimuthDeg = 0, .elevationDeg = 90}},
  };
  ComparedScene compared{scene, source};
  for (const auto& view : views) {
    scene.camera = view.camera;
    const Difference d = compared.difference(resolveCamera(scene, {grid, false}));
    EXPECT_TRUE(d.finite) << view.name;
    EXPECT_LE(d.largest, kReferenceBound) << view.name << ", rms " << d.rms;
  }
  scene.camera = {.verticalFovDeg = 70};
  scene.camera.eye = grid.centreWorld() + glm::dvec3{1, 2, 3};
  scene.camera.target = grid.centreWorld() + glm::dvec3{-10, 4, 9};
  EXPECT_LE(compared.difference(resolveCamera(scene, {grid, false})).largest, kReferenceBound)
      << "inside";
}

INSTANTIATE_TEST_SUITE_P(Styles, AgainstReference, testing::ValuesIn(drawnStyles()),
                         [](const auto& style) { return style.param; });

TEST(AgainstReference, TwoLayersLightsAndClipPlanes) {
  ArraySource source = smoothVolume(gridOf({36, 36, 36}));
  Scene scene = sceneWithStyle("all");
  scene.layers.push_back(sceneWithStyle("tone").layers[0]);
  scene.layers[1].styles[0].values[0] = std::string{"gooch"};
  scene.layers[1].transferFunction.points = {
      {0.1, {200, 30, 200}, 0.1}, {0.45, {90, 255, 20}, 0.3}, {0.46, {0, 0, 0}, 0}};
  scene.lights = {{.direction = {1, 0.3, 0.2}, .eyeSpace = false, .colour = {255, 180, 90}},
                  {.direction = {-0.4, 1, 1}, .intensity = 0.6}};
  scene.clip = {{{1, 0.2, 0}, -14.3}, {{0, -1, 0.4}, 20}};
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  EXPECT_LE(againstReference(scene, source, camera).largest, kReferenceBound);
  EXPECT_LE(againstReference(scene, source, camera, {.bricks = 7}).largest, kReferenceBound);
}

TEST(AgainstReference, ClipBoxAndCutSurfaces) {
  VolumeGrid grid = gridOf({36, 30, 33}, {1, 1.2, 0.8});
  grid.direction = {glm::normalize(glm::dvec3{1, 0.3, 0}), glm::normalize(glm::dvec3{-0.3, 1, 0}),
                    glm::dvec3{0, 0, 1}};
  ArraySource source = smoothVolume(grid);
  Scene scene = sceneWithStyle("all");
  scene.imageSize = {40, 32};
  for (TransferPoint& point : scene.layers[0].transferFunction.points)
    point.opacity = std::max(point.opacity, 0.3);  // so that there is something at every cut
  const glm::dvec3 centre = grid.centreWorld();
  scene.clip = {{{1, 0.2, -0.3}, -glm::dot({1, 0.2, -0.3}, centre)}};
  scene.clipBox = ClipBox{centre - 9.0, centre + glm::dvec3{12, 7, 10}};
  scene = resolved(scene, source);
  Image<Rgba> pictures[2];
  for (const bool hasCap : {false, true}) {
    scene.clip[0].hasCap = scene.clipBox->hasCap = hasCap;
    for (const char* normal : {"outward", "facing"}) {
      scene.layers[0].styles.front().values[2] = std::string{normal};
      scene.camera.azimuthDeg = normal == std::string{"facing"} ? -60 : 60;
      const Camera camera = resolveCamera(scene, {grid, false});
      EXPECT_LE(againstReference(scene, source, camera).largest, kReferenceBound);
      const Difference cut = againstReference(scene, source, camera, {.bricks = 7});
      EXPECT_LE(cut.largest, kReferenceBound);
      pictures[hasCap ? 1 : 0] = drawAlone(scene, source, camera);
    }
  }
  EXPECT_GT(difference(pictures[0], pictures[1]).largest, 0.05) << "no cut surface is seen";
}

TEST(AgainstReference, AnOperatorForEachLayer) {
  ArraySource source = smoothVolume(gridOf({30, 33, 28}, {1, 1.4, 0.8}));
  Scene scene = sceneWithStyle("sobel");
  scene.imageSize = {48, 40};
  scene.layers.push_back(sceneWithStyle("regression").layers[0]);
  scene.layers.push_back(sceneWithStyle("surface").layers[0]);
  scene.layers[1].transferFunction.points = {
      {0.1, {200, 30, 200}, 0.1}, {0.45, {90, 255, 20}, 0.3}, {0.52, {0, 0, 0}, 0}};
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  EXPECT_LE(againstReference(scene, source, camera).largest, kReferenceBound);
  EXPECT_LE(againstReference(scene, source, camera, {.bricks = 7}).largest, kReferenceBound);
}

TEST(AgainstReference, NanAndInfiniteVoxels) {
  const auto value = [](glm::ivec3 i) {
    const float f = static_cast<float>(smoothField(glm::dvec3{i}));
    if (i.x > 10 && i.x < 16 && i.y > 8 && i.y < 20) return std::nanf("");
    if (i.z == 20 && i.y == 20) return std::numeric_limits<float>::infinity();
    if (i.z == 8 && i.x == 22) return -std::numeric_limits<float>::infinity();
    return f;
  };
  ArraySource source{gridOf({30, 30, 30}), value};
  const Scene scene = resolved(sceneWithStyle("plain"), source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  // A sample counts as valid from weight 1/2 on; one whose weight rounds across that differs by its
  // whole opacity, at most 0.5 per voxel times the half-voxel step. Such samples must be rare.
  const Difference d = againstReference(scene, source, camera, {.bricks = 3});
  EXPECT_TRUE(d.finite);
  EXPECT_LE(d.rms, 2e-4);
  EXPECT_LE(d.largest, 0.3);
}

/// A cube of constant value with extinction `sigma` per world unit.
Scene slabScene(double opacity) {
  Scene scene = sceneWithStyle("plain");
  scene.layers[0].transferFunction = {
      {{0, {255, 255, 255}, opacity}, {1, {255, 255, 255}, opacity}}, 1.0};
  return scene;
}

TEST(ClosedForm, HomogeneousSlab) {
  // Axis-parallel views: the chord is the edge, L = 20 world units for every ray that hits.
  ArraySource source{gridOf({21, 21, 21}), [](glm::ivec3) { return 0.25f; }};
  for (const double opacity : {1e-6, 1e-3, 0.05, 0.3, 0.9})
    for (const double step : {0.3, 0.5, 1.7}) {
      Scene scene = slabScene(opacity);
      scene.quality.stepVoxels = step;
      scene.camera = {.azimuthDeg = 0, .elevationDeg = 0, .projection = Projection::kOrthographic};
      scene = resolved(scene, source);
      const Camera camera = resolveCamera(scene, {source.info().grid, false});
      const Image<Rgba> image = drawAlone(scene, source, camera, {.bricks = 3});
      const double expected = -std::expm1(20 * std::log1p(-opacity));
      // Issue's bound 1e-5; relative for faint slabs, where an absolute one would show nothing.
      EXPECT_NEAR(double{image.at(36, 28).a} / expected, 1, 1e-5) << opacity << " " << step;
      EXPECT_NEAR(double{image.at(36, 28).r} / expected, 1, 1e-5) << opacity << " " << step;
    }
}

TEST(Convergence, SecondOrderInTheStep) {
  // Smooth data (a quadratic field's trilinear interpolant is only piecewise smooth, so the field
  // is linear) and a smooth transfer function (linear opacity: its extinction is smooth), faces and
  // an oblique perspective view included. Halving the step must divide the error by almost 4.
  ArraySource source{gridOf({17, 17, 17}), [](glm::ivec3 i) {
                       return static_cast<float>((i.x + 2 * i.y + 3 * i.z) / 96.0);
                     }};
  Scene scene = sceneWithStyle("plain");
  scene.layers[0].transferFunction = {{{0, {255, 0, 0}, 0.02}, {1, {0, 0, 255}, 0.4}}, 1.0};
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const auto at = [&](double step) {
    scene.quality.stepVoxels = step;
    return drawAlone(scene, source, camera);
  };
  const Image<Rgba> truth = at(1.0 / 64);
  // From step 1 on the series is asymptotic; at 1/8 its error is still 50 times float rounding.
  const double coarse = difference(at(1), truth).rms;
  const double middle = difference(at(0.25), truth).rms;
  const double fine = difference(at(0.125), truth).rms;
  const double order = std::log2(coarse / fine) / 3;
  std::printf("errors (rms) at steps 1, 1/4, 1/8: %.3g %.3g %.3g, observed order %.3f\n", coarse,
              middle, fine, order);
  EXPECT_GE(order, 1.9);
}

}  // namespace
}  // namespace burin::test
