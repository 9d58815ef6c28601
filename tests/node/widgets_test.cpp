// Two-dimensional transfer functions against closed forms. Bricks, ranks, skipping, slices and the
// reference are the business of the tests that go over all styles ("widgets").

#include <gtest/gtest.h>

#include "support/against_reference.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

/// White widgets, opacities per world unit, seen along the x axis (or along z) by parallel rays;
/// gradients over their maximum.
Scene sceneWith(std::vector<TransferWidget> widgets, bool alongX, double stepVoxels) {
  Scene scene = sceneWithStyle("plain");
  Layer& layer = scene.layers[0];
  layer.transferFunction = {{}, 1.0, std::move(widgets)};
  layer.styles = {defaultSettings(*findStyle("gradient"))};
  layer.styles[0].values[3] = std::string{"maximum"};  // the table's parameter "magnitude"
  scene.imageSize = {24, 24};
  scene.camera = {.azimuthDeg = alongX ? 90.0 : 0.0,
                  .elevationDeg = 0,
                  .projection = Projection::kOrthographic};
  scene.quality.stepVoxels = stepVoxels;
  return scene;
}

/// Of the pixel in the middle.
double middleOpacity(Scene scene, node::BrickSource& source) {
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  return double{drawAlone(scene, source, camera, {.bricks = 3}).at(12, 12).a};
}

TransferWidget whiteWidget(WidgetShape shape, const glm::dvec2& value, const glm::dvec2& gradient,
                           double opacity) {
  return {.shape = shape,
          .value = value,
          .gradient = gradient,
          .colour = {255, 255, 255},
          .opacity = opacity};
}

TEST(Widgets, HomogeneousSlabInARectangle) {
  // No gradients anywhere: m = 0, which a rectangle from 0 on holds in full.
  ArraySource source{gridOf({21, 21, 21}), [](glm::ivec3) { return 0.25f; }};
  for (const double opacity : {1e-6, 0.05, 0.3})
    for (const bool preintegrated : {true, false}) {
      Scene scene = sceneWith({whiteWidget(WidgetShape::kRectangle, {0.1, 0.4}, {0, 0.3}, opacity)},
                              true, 0.7);
      scene.quality.preintegrated = preintegrated;
      // The project's bound for slabs, relative.
      EXPECT_NEAR(middleOpacity(scene, source) / -std::expm1(20 * std::log1p(-opacity)), 1, 1e-5)
          << opacity;
    }
}

TEST(Widgets, ValuesOf16BitsNextToEachOther) {
  // Eight values of 65536, at whose either edge extinction rises over two. A value looked up and
  // the widget's first one round by 2^-24 of the type's range, 1/256 of a value, each.
  constexpr double kRounding = 2.0 / 256 / 2;
  for (const int value : {39996, 39997, 40000, 40003, 40004}) {
    ArraySource source = ArraySource::of<std::uint16_t>(
        gridOf({9, 9, 9}), node::VoxelType::kU16,
        [&](glm::ivec3 i) { return static_cast<std::uint16_t>(i.z == 0 ? 0 : value); });
    TransferWidget widget = whiteWidget(WidgetShape::kRectangle, {39996, 40004}, {0, 1}, 0.2);
    widget.valueFalloff = 0.5;
    const double expected = std::clamp((4.0 - std::abs(value - 40000)) / 2, 0.0, 1.0);
    Scene scene = sceneWith({widget}, true, 0.5);
    const double depth = -std::log1p(-middleOpacity(scene, source)) / -std::log1p(-0.2);
    EXPECT_NEAR(depth / 8, expected, kRounding) << value;
  }
}

constexpr double kSlope = 1.0 / 70;

/// Values rise along x: by kSlope a voxel up to 3/7 at voxel 30, where m = 1/4, then four times as
/// fast up to 1 at voxel 40, where m = 1.
ArraySource bentRamp() {
  return ArraySource{
      gridOf({41, 11, 11}), [](glm::ivec3 i) {
        return static_cast<float>(kSlope * (std::min(i.x, 30) + 4 * std::max(i.x - 30, 0)));
      }};
}
/// By which a look-up may be off where a texture's size is no power of two (design), of the values.
constexpr double kLookUpError = 1.5e-5;

TEST(Widgets, TrianglesShowSteepnessOfTheirOwn) {
  // At m = 1/4 a triangle is a quarter as wide as at its top. On either part of the ramp extinction
  // is a tent, so its integral half its width times its height; both lie away from the bend, so
  // pre-integration is exact at any step. Errors of look-ups over the narrower tent's half width,
  // relative to its mean, 1/2, all of one sign: 2 * 1.5e-5 / 0.0525.
  constexpr double kRelative = 2 * kLookUpError / 0.0525;
  ArraySource source = bentRamp();
  for (const double step : {0.4, 1.7}) {
    TransferWidget shallow = whiteWidget(WidgetShape::kTriangle, {0, 0.42}, {0.1, 1}, 0.05);
    shallow.gradientFalloff = 0.05;
    TransferWidget steep = whiteWidget(WidgetShape::kTriangle, {0.6, 0.9}, {0.5, 1}, 0.05);
    const double extinction = -std::log1p(-0.05);
    const double expectedShallow = extinction * 0.5 * (0.25 * 0.42 / kSlope);
    const double expectedSteep = extinction * 0.5 * (0.3 / (4 * kSlope));
    const auto depth = [&](const std::vector<TransferWidget>& widgets) {
      return -std::log1p(-middleOpacity(sceneWith(widgets, true, step), source));
    };
    EXPECT_NEAR(depth({shallow}) / expectedShallow, 1, kRelative) << step;
    EXPECT_NEAR(depth({steep}) / expectedSteep, 1, kRelative) << step;
    EXPECT_NEAR(depth({shallow, steep}) / (expectedShallow + expectedSteep), 1, kRelative) << step;
    // Above its lower gradient alone.
    shallow.gradient.x = 0.3;
    EXPECT_EQ(depth({shallow}), 0);
  }
}

TEST(Widgets, SpikesInValueAreNotMissed) {
  // A thousandth of the values, a fourteenth of a voxel where it lies, in steps of two voxels, of
  // which the values are 2/70 long and known to twice the look-up's error.
  constexpr double kRelative = 2 * kLookUpError / (2 * kSlope);
  ArraySource source = bentRamp();
  for (const WidgetShape shape :
       {WidgetShape::kTriangle, WidgetShape::kRectangle, WidgetShape::kEllipse}) {
    TransferWidget spike = whiteWidget(shape, {0.2, 0.201}, {0, 0.9}, 0.99);
    if (shape == WidgetShape::kEllipse) spike.gradient = {-0.5, 1};  // m = 1/4 is its middle
    if (shape == WidgetShape::kTriangle) spike.gradient = {0, 0.25 / 0.75};
    const double part = shape == WidgetShape::kTriangle    ? 0.5 * 0.75
                        : shape == WidgetShape::kRectangle ? 0.875
                                                           : 8.0 / 15;
    const double depth =
        -std::log1p(-middleOpacity(sceneWith({spike}, true, 2), source)) / -std::log1p(-0.99);
    EXPECT_NEAR(depth / (part * 0.001 / kSlope), 1, 1.1 * kRelative) << static_cast<int>(shape);
  }
}

TEST(Widgets, SecondOrderInTheStep) {
  // f = x y is its own trilinear interpolant, with |grad f| = |(x, y)|; both vary along every ray.
  // A clip box keeps away from the volume's faces, where gradients are one-sided, and the ellipse
  // holds all of it, so that everything is smooth.
  ArraySource source{gridOf({17, 17, 17}),
                     [](glm::ivec3 i) { return static_cast<float>(i.x * i.y / 256.0); }};
  TransferWidget first = whiteWidget(WidgetShape::kEllipse, {-0.5, 1.5}, {-1, 2}, 0.3);
  first.colour = {255, 0, 0};
  TransferWidget second = whiteWidget(WidgetShape::kEllipse, {-1, 3}, {-0.5, 2}, 0.2);
  second.colour = {0, 0, 255};
  Scene scene = sceneWith({first, second}, true, 1);
  scene.camera = {.azimuthDeg = 30, .elevationDeg = 20};
  scene.clipBox = ClipBox{glm::dvec3{2}, glm::dvec3{14}};
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  for (const bool preintegrated : {true, false}) {
    scene.quality.preintegrated = preintegrated;
    const auto at = [&](double step) {
      scene.quality.stepVoxels = step;
      return drawAlone(scene, source, camera);
    };
    const Image<Rgba> truth = at(1.0 / 64);
    // At 1/8 the error is still ten times a float's rounding.
    const double coarse = difference(at(1), truth).rms;
    const double fine = difference(at(0.125), truth).rms;
    const double order = std::log2(coarse / fine) / 3;
    std::printf("errors (rms) at steps 1, 1/8: %.3g %.3g, observed order %.3f%s\n", coarse, fine,
                order, preintegrated ? ", pre-integrated" : "");
    EXPECT_GE(order, 1.9);
  }
}

TEST(Widgets, AmongOtherLayersAgainstTheReference) {
  ArraySource source = smoothVolume(gridOf({30, 33, 28}, {1, 1.4, 0.8}));
  Scene scene = sceneWithStyle("light");
  scene.imageSize = {40, 32};
  scene.layers.push_back(sceneWithStyle("sobel").layers[0]);  // an operator of its own
  scene.layers[1].transferFunction = gentleWidgets();
  scene.layers.push_back(sceneWithStyle("widgets").layers[0]);
  for (TransferWidget& widget : scene.layers[2].transferFunction.widgets) widget.value -= 0.15;
  scene.quality.preintegrated = false;  // with it, against_reference_test.cpp
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  EXPECT_LE(againstReference(scene, source, camera, {.bricks = 5}).largest, kReferenceBound);
}

}  // namespace
}  // namespace burin::test
