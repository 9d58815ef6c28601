#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "burin/common/error.hpp"
#include "burin/common/scene.hpp"

namespace burin {
namespace {

// Directions come from sines and cosines of a few degrees: a few ulp of 1, after normalising.
constexpr double kDirectionTolerance = 1e-14;

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = kDirectionTolerance) {
  EXPECT_LE(glm::length(a - b), tolerance)
      << a.x << ' ' << a.y << ' ' << a.z << " against " << b.x << ' ' << b.y << ' ' << b.z;
}

/// 11 × 21 × 41 voxels of spacing 1 × 0.5 × 0.25 from (5, 6, 7): a cube of side 10.
VolumeFacts cubeFacts(bool anatomical) {
  VolumeFacts facts;
  facts.grid.dims = {11, 21, 41};
  facts.grid.spacing = {1, 0.5, 0.25};
  facts.grid.origin = {5, 6, 7};
  facts.anatomical = anatomical;
  return facts;
}
const glm::dvec3 kCentre{10, 11, 12};
const double kRadius = 5 * std::sqrt(3.0);

Scene sceneWithView(const std::string& view) {
  Scene scene;
  scene.camera.view = view;
  return scene;
}

struct NamedView {
  const char* name;
  glm::dvec3 toEye, up, right;
};

TEST(ResolveCamera, NamedViewsAreLps) {
  // LPS: x to the patient's left, y to the back, z up. Facing the patient, their left is at our
  // right; from above and below, the patient's left stays at our right, as seen from the front.
  const NamedView views[] = {{"anterior", {0, -1, 0}, {0, 0, 1}, {1, 0, 0}},
                             {"posterior", {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}},
                             {"left", {1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                             {"right", {-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                             {"superior", {0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
                             {"inferior", {0, 0, -1}, {0, -1, 0}, {1, 0, 0}}};
  for (const NamedView& view : views) {
    for (const bool anatomical : {true, false}) {
      SCOPED_TRACE(view.name);
      const Camera camera = resolveCamera(sceneWithView(view.name), cubeFacts(anatomical));
      expectNear(camera.forward, -view.toEye);
      expectNear(camera.up, view.up);
      expectNear(camera.right, view.right);
      const double distance = kRadius / std::sin(glm::radians(15.0));
      expectNear(camera.eyeWorld, kCentre + distance * view.toEye, 1e-12);
    }
  }
}

TEST(ResolveCamera, UnknownViewIsAnError) {
  EXPECT_THROW(resolveCamera(sceneWithView("front"), cubeFacts(true)), Error);
}

TEST(ResolveCamera, AutoUpIsZForAnatomicalVolumesElseY) {
  Scene scene;
  scene.camera.azimuthDeg = 0;
  scene.camera.elevationDeg = 0;
  expectNear(resolveCamera(scene, cubeFacts(true)).forward, {0, 1, 0});
  expectNear(resolveCamera(scene, cubeFacts(true)).up, {0, 0, 1});
  expectNear(resolveCamera(scene, cubeFacts(false)).forward, {0, 0, -1});
  expectNear(resolveCamera(scene, cubeFacts(false)).up, {0, 1, 0});
  scene.camera.upAxis = std::string{"y"};  // gcc 12 warns falsely about = "y"
  expectNear(resolveCamera(scene, cubeFacts(true)).up, {0, 1, 0});
  scene.camera.upAxis = std::string{"z"};
  expectNear(resolveCamera(scene, cubeFacts(false)).up, {0, 0, 1});
}

TEST(ResolveCamera, AnglesFollowTheContract) {
  Scene scene;
  scene.camera.azimuthDeg = 40;
  scene.camera.elevationDeg = -25;
  const double az = glm::radians(40.0), el = glm::radians(-25.0);
  expectNear(resolveCamera(scene, cubeFacts(false)).forward,
             -glm::dvec3{std::sin(az) * std::cos(el), std::sin(el), std::cos(az) * std::cos(el)});
  expectNear(resolveCamera(scene, cubeFacts(true)).forward,
             -glm::dvec3{std::sin(az) * std::cos(el), -std::cos(az) * std::cos(el), std::sin(el)});
}

TEST(ResolveCamera, OrbitAddsToTheAzimuth) {
  for (const bool anatomical : {true, false}) {
    Scene scene;
    scene.camera.azimuthDeg = 70;
    const Camera expected = resolveCamera(scene, cubeFacts(anatomical));
    scene.camera.azimuthDeg = 20;
    const Camera turned = resolveCamera(scene, cubeFacts(anatomical), 50);
    expectNear(turned.forward, expected.forward);
    expectNear(turned.eyeWorld, expected.eyeWorld, 1e-12);
  }
  expectNear(resolveCamera(sceneWithView("anterior"), cubeFacts(true), 90).forward, {-1, 0, 0});
}

TEST(ResolveCamera, OrbitTurnsAnExplicitEyeTheSameWay) {
  for (const bool anatomical : {true, false}) {
    Scene orbit;
    const Camera start = resolveCamera(orbit, cubeFacts(anatomical));
    Scene explicitEye;
    explicitEye.camera.eye = start.eyeWorld;  // target and up as by default: centre, auto
    const Camera same = resolveCamera(explicitEye, cubeFacts(anatomical));
    expectNear(same.forward, start.forward);
    expectNear(same.up, start.up);
    const Camera a = resolveCamera(orbit, cubeFacts(anatomical), 77);
    const Camera b = resolveCamera(explicitEye, cubeFacts(anatomical), 77);
    expectNear(a.eyeWorld, b.eyeWorld, 1e-12);
    expectNear(a.up, b.up);
  }
}

TEST(ResolveCamera, ExplicitEyeTargetAndUp) {
  Scene scene;
  scene.camera.eye = glm::dvec3{1, 2, 9};
  scene.camera.target = glm::dvec3{1, 2, 3};
  scene.camera.upVector = glm::dvec3{5, 0, 2};  // neither unit nor perpendicular
  const Camera camera = resolveCamera(scene, cubeFacts(true));
  EXPECT_EQ(camera.eyeWorld, (glm::dvec3{1, 2, 9}));
  expectNear(camera.forward, {0, 0, -1});
  expectNear(camera.up, {1, 0, 0});
  expectNear(camera.right, {0, -1, 0});
}

TEST(ResolveScene, OpacityUnitLengthBecomesTheSmallestSpacing) {
  Scene scene;
  scene.layers.resize(2);
  scene.layers[1].transferFunction.opacityUnitLength = 3;
  resolveScene(scene, cubeFacts(true));
  EXPECT_EQ(scene.layers[0].transferFunction.opacityUnitLength, 0.25);
  EXPECT_EQ(scene.layers[1].transferFunction.opacityUnitLength, 3);
  const Scene once = scene;
  resolveScene(scene, VolumeFacts{});
  EXPECT_EQ(scene, once);
}

TEST(LightDirection, EyeSpaceIsRightUpAndToTheViewer) {
  const Camera camera = resolveCamera(sceneWithView("left"), cubeFacts(true));
  const auto direction = [&](const glm::dvec3& d, bool eyeSpace) {
    return lightDirectionWorld(Light{d, eyeSpace, {}, 1}, camera);
  };
  expectNear(direction({2, 0, 0}, true), camera.right);
  expectNear(direction({0, 3, 0}, true), camera.up);
  expectNear(direction({0, 0, 4}, true), -camera.forward);
  // From the left: right is y, up is z, the viewer is at +x.
  expectNear(direction({1, 2, 2}, true), glm::dvec3{2, 1, 2} / 3.0);
  expectNear(direction({1, 2, -2}, false), glm::dvec3{1, 2, -2} / 3.0);
}

TEST(SceneNeeds, GhostLayersAndGradientsFollowTheStyles) {
  Scene scene;
  scene.layers.resize(2);
  EXPECT_EQ(ghostLayersNeeded(scene), 1);  // half a pre-integrated segment
  scene.quality = {.stepVoxels = 1.9, .preintegrated = true};
  EXPECT_EQ(ghostLayersNeeded(scene), 1);
  scene.quality.stepVoxels = 2;  // at 30° fov oblique segments are longer than the planes' distance
  EXPECT_EQ(ghostLayersNeeded(scene), 2);
  scene.camera.projection = Projection::kOrthographic;
  EXPECT_EQ(ghostLayersNeeded(scene), 1);
  scene.quality.preintegrated = false;
  EXPECT_EQ(ghostLayersNeeded(scene), 0);
  EXPECT_FALSE(gradientNeeded(scene));
  scene.layers[0].styles = {defaultSettings(*findStyle("gradient"))};  // settings of nothing
  EXPECT_EQ(ghostLayersNeeded(scene), 0);
  EXPECT_FALSE(gradientNeeded(scene));
  scene.layers[1].styles = {defaultSettings(*findStyle("edges"))};
  EXPECT_EQ(ghostLayersNeeded(scene), 1);
  EXPECT_TRUE(gradientNeeded(scene));
  EXPECT_FALSE(laplacianNeeded(scene));
  scene.layers[0].styles = {defaultSettings(*findStyle("laplacian"))};
  EXPECT_EQ(ghostLayersNeeded(scene), 3);
  EXPECT_TRUE(laplacianNeeded(scene));
}

TEST(SceneNeeds, GradientOperatorsOfTheLayersThatHaveGradients) {
  Scene scene;
  scene.layers.resize(2);
  StyleSettings sobel = defaultSettings(*findStyle("gradient"));
  sobel.values[0] = std::string{"sobel"};
  scene.layers[0].styles = {sobel};
  scene.layers[1].styles = {defaultSettings(*findStyle("edges"))};
  EXPECT_EQ(gradientOperator(scene.layers[0]), GradientOperator::kSobel);
  EXPECT_FALSE(gradientOperatorsNeeded(scene).contains(GradientOperator::kSobel));
  EXPECT_TRUE(gradientOperatorsNeeded(scene).contains(GradientOperator::kCentral));
  scene.layers[0].styles.push_back(defaultSettings(*findStyle("tone")));
  EXPECT_TRUE(gradientOperatorsNeeded(scene).contains(GradientOperator::kSobel));
}

TEST(ClipPlanes, ABoxIsItsSixFaces) {
  Scene scene;
  scene.clip = {{{1, 2, 3}, 4}};
  scene.clipBox = ClipBox{{-1, -2, -3}, {4, 5, 6}, false};
  const std::vector<ClipPlane> planes = clipPlanes(scene);
  ASSERT_EQ(planes.size(), 7u);
  EXPECT_EQ(planes[0], scene.clip[0]);
  const auto isKept = [&](const glm::dvec3& p) {
    return std::ranges::all_of(planes.begin() + 1, planes.end(), [&](const ClipPlane& plane) {
      return glm::dot(plane.normal, p) + plane.offset >= 0;
    });
  };
  EXPECT_TRUE(isKept({-1, -2, -3}));
  EXPECT_TRUE(isKept({4, 5, 6}));
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 p{0};
    p[axis] = -3.5;
    EXPECT_FALSE(isKept(p));
    p[axis] = 6.5;
    EXPECT_FALSE(isKept(p));
    EXPECT_FALSE(planes[1 + 2 * static_cast<std::size_t>(axis)].hasCap);
  }
}

}  // namespace
}  // namespace burin
