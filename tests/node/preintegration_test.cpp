// Pre-integrated classification: against the reference at every step, spikes against a closed form,
// the ghost layers it needs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/against_reference.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

TEST(Preintegration, AgreesWithTheReferenceAtEveryStep) {
  ArraySource source = smoothVolume(gridOf({40, 33, 36}, {1, 1.2, 0.8}));
  for (const char* style : {"plain", "all"})
    for (const double step : {0.1, 0.9, 1.7, 3.0, 7.0}) {
      Scene scene = sceneWithStyle(style);
      scene.quality.stepVoxels = step;
      scene = resolved(scene, source);
      const Camera camera = resolveCamera(scene, {source.info().grid, false});
      EXPECT_LE(againstReference(scene, source, camera, {.bricks = 2}).largest, kReferenceBound)
          << style << " " << step;
    }
}

/// f = z / 40 along an axis-parallel view: the optical depth of a transfer function is 40 times its
/// integral over the value, whatever the step.
Scene rampScene(const TransferFunction& function, double step) {
  Scene scene = sceneWithStyle("plain");
  scene.layers[0].transferFunction = function;
  scene.quality.stepVoxels = step;
  scene.camera = {.azimuthDeg = 0, .elevationDeg = 0, .projection = Projection::kOrthographic};
  return scene;
}

TEST(Preintegration, SpikesAreSeenAtAnyStep) {
  ArraySource source{gridOf({9, 9, 41}),
                     [](glm::ivec3 i) { return static_cast<float>(i.z) / 40.0f; }};
  // A triangle of opacity, height o and half width w: the integral of -ln(1 - opacity) over it is
  // 2 w ((1 - o) ln(1 - o) + o) / o. Narrow enough that no midpoint of steps 1 … 7 need meet it.
  constexpr double o = 0.9;
  for (const double w : {0.02, 0.004, 0.0005}) {
    const TransferFunction spike{
        {{0.4 - w, {200, 100, 50}, 0}, {0.4, {200, 100, 50}, o}, {0.4 + w, {200, 100, 50}, 0}},
        1.0};
    const double depth = 40 * 2 * w * ((1 - o) * std::log(1 - o) + o) / o;
    const double expected = -std::expm1(-depth);
    for (const double step : {0.3, 1.0, 2.0, 7.0}) {
      const Scene scene = resolved(rampScene(spike, step), source);
      const Camera camera = resolveCamera(scene, {source.info().grid, false});
      const Image<Rgba> image = drawAlone(scene, source, camera);
      const Rgba middle = image.at(36, 28);
      // The table keeps a unit length's opacity right to 1e-6 between its entries, so its integral
      // to about 1e-6 of the spike's width; trilinear values are off by 2^-16 of the range at most,
      // which shifts the spike and changes nothing here. 1e-4 leaves room for single precision.
      EXPECT_NEAR(double{middle.a}, expected, 1e-4) << w << " " << step;
      // One colour all over the spike stays that colour: premultiplied, as bright as it is opaque.
      const glm::dvec3 colour = Colour{200, 100, 50}.linear();
      EXPECT_NEAR(double{middle.r}, colour.r * expected, 1e-3) << w << " " << step;
      EXPECT_NEAR(double{middle.b}, colour.b * expected, 1e-3) << w << " " << step;
    }
  }
}

TEST(Preintegration, OneGhostLayerLessShows) {
  ArraySource source = smoothVolume(gridOf({40, 33, 36}));
  Scene scene = sceneWithStyle("plain");
  scene.quality.stepVoxels = 3.5;
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const int needed = ghostLayersNeeded(scene);
  ASSERT_EQ(needed, 2);
  const Image<Rgba> whole = drawAlone(scene, source, camera);
  const auto cut = [&](int ghosts) {
    return difference(whole, drawAlone(scene, source, camera, {.bricks = 5, .ghostLayers = ghosts}))
        .largest;
  };
  EXPECT_LE(cut(needed), 5e-5);
  EXPECT_GT(cut(needed - 1), 1e-3);
}

}  // namespace
}  // namespace burin::test
