// Layers that are surfaces: where they lie, how they look, and that they are the same for any
// bricks.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "burin/common/error.hpp"
#include "node/layer_modes.hpp"
#include "support/against_reference.hpp"

namespace burin::test {
namespace {

TEST(IsoSurface, LiesWhereTheTrilinearFieldHasItsValueWithItsNormal) {
  const glm::dvec3 centre{11.3, 11.7, 11.1};
  const VolumeGrid grid = gridOf({24, 24, 24});
  ArraySource source{grid, [&](glm::ivec3 i) {
                       const glm::dvec3 d = glm::dvec3{i} - centre;
                       return static_cast<float>(glm::dot(d, d));
                     }};
  constexpr double kIso = 81;
  Scene scene = sceneWithStyle("plain");
  // Opacity tells where along z a surface lies, colour its normal.
  scene.layers = {isoLayer(kIso, 1,
                           {makeStyle("fade", {{"along", std::string{"axis"}},
                                               {"axis", glm::dvec3{0, 0, 1}},
                                               {"opacity", Curve{{{0, 0}, {1, 1}}}}}),
                            makeStyle("light", {{"normal_color", 1.0}})})};
  scene.clip = {{{0, 0, 1}, -centre.z, false}};
  scene.camera = {.azimuthDeg = 14, .elevationDeg = 11};
  for (const bool preintegrated : {true, false}) {
    scene.quality.preintegrated = preintegrated;
    const Scene made = resolved(scene, source);
    const Camera camera = resolveCamera(made, {grid, false});
    const Image<Rgba> image = drawAlone(made, source, camera, {.bricks = 3});
    int met = 0;
    for (int row = 0; row < image.size().height; ++row)
      for (int column = 0; column < image.size().width; ++column) {
        const glm::dvec3 direction =
            camera.forward +
            camera.pixelSize * ((column + 0.5 - 0.5 * image.size().width) * camera.right +
                                (0.5 * image.size().height - row - 0.5) * camera.up);
        const Rgba& pixel = image.at(column, row);
        const glm::dvec3 along = glm::normalize(direction);
        const glm::dvec3 toCentre = centre - camera.eyeWorld;
        const double nearest = glm::length(glm::cross(toCentre, along));
        if (nearest > 9) {
          EXPECT_EQ(pixel.a, 0) << column << " " << row;
        }
        if (nearest > 8.95) continue;  // t (1 - t) is at most 1/4 along an axis: 81 - 3/4 = 8.958²
        // The plane cuts off where other rays enter the ball, or does not where they leave it.
        const double half = std::sqrt(81 - nearest * nearest);
        const auto heightAt = [&](double depth) {
          return (camera.eyeWorld + depth * along).z - centre.z;
        };
        const double middle = glm::dot(toCentre, along);
        if (heightAt(middle - half) < 0.5 || heightAt(middle + half) > -0.5) continue;
        const double z = 23 * double{pixel.a};
        const glm::dvec3 hit = camera.eyeWorld + (z - camera.eyeWorld.z) / direction.z * direction;
        const glm::dvec3 part = hit - glm::floor(hit);
        const glm::dvec3 away = hit - centre;
        // Between voxels, x² interpolated is x² + t (1 - t). The hit is known to 5e-6 (1e-5 of a
        // step) and to a few roundings of 23 and of a field of 400 (3e-5, over its slope of 18); z
        // says it twice as badly at most. Times the slope: 4e-4.
        EXPECT_NEAR(glm::dot(away, away) + glm::dot(part, 1.0 - part), kIso, 4e-4)
            << column << " " << row;
        // Central differences of a parabola are exact, up to the field's rounding over 2 · 18.
        const glm::dvec3 normal = -glm::normalize(away);
        const glm::dvec3 seen = glm::dvec3{pixel.r, pixel.g, pixel.b} / double{pixel.a};
        EXPECT_LE(glm::length(seen - (normal / 2.0 + 0.5)), 2e-5) << column << " " << row;
        ++met;
      }
    EXPECT_GT(met, 300);
  }
}

TEST(IsoSurface, NothingIsLostOrDoubledAtSplitPlanes) {
  // Planes of voxels are where bricks meet, and the view is along the axis: whole surfaces lie in
  // them.
  const VolumeGrid grid = gridOf({41, 6, 6});
  ArraySource source{grid, [](glm::ivec3 i) { return static_cast<float>(i.x); }};
  Scene scene = sceneWithStyle("plain");
  scene.imageSize = {12, 12};
  scene.layers = {isoLayer(20, 0.5, {})};
  const Communicator self{MPI_COMM_SELF};
  for (const int bricks : {1, 2, 8}) {
    node::Worker worker{
        self, resolved(scene, source), source, {.bricks = bricks, .wholeBricks = true}};
    for (const double value : {20.0, 10.0, 5.0, 30.0, 20.0000001, 19.9999999, 12.3})
      for (const double step : {1.0, 0.5, 0.37})
        for (const double azimuth : {90.0, -90.0, 90.00001, 60.0}) {
          scene.layers[0].isoValue = value;
          scene.quality.stepVoxels = step;
          scene.camera = {.azimuthDeg = azimuth,
                          .elevationDeg = 0,
                          .zoom = 12,
                          .projection = Projection::kOrthographic};
          const Scene made = resolved(scene, source);
          worker.update(made);
          RankStatistics statistics;
          const Image<Rgba> image =
              wholeFrame(worker.draw(resolveCamera(made, {grid, false}), statistics));
          // Zoomed so that all rays pass all of the x axis but for the oblique ones.
          for (const Rgba& pixel : image.pixels()) {
            if (azimuth == 60.0) {
              EXPECT_THAT(pixel.a, testing::AnyOf(0.0f, 0.5f)) << value << " " << bricks;
            } else {
              EXPECT_EQ(pixel.a, 0.5f) << value << " " << step << " " << azimuth << " " << bricks;
            }
          }
        }
  }
}

/// What a picture of 7 bricks differs by from the reference, beyond the slack.
Difference beyondReference(const Scene& scene, node::BrickSource& source) {
  const Scene made = resolved(scene, source);
  const Camera camera = resolveCamera(made, {source.info().grid, false});
  const DrawnAndTrue both = drawWithReference(made, source, camera, {.bricks = 7});
  EXPECT_GT(largestAlpha(both.drawn), 0.3);
  return differenceBeyond(surfaceSlack(made, source, camera),
                          std::span<const Rgba>{both.drawn.pixels()},
                          std::span<const ReferencePixel>{both.truth});
}

TEST(IsoSurface, IsTheReferences) {
  ArraySource source = smoothVolume(gridOf({36, 33, 34}, {1, 1.2, 0.8}));
  for (const char* name : {"alone", "media"}) {
    Scene scene = isoScene(name);
    scene.clip = {{{1, 0.2, -0.3}, -8}};
    scene.camera = {.azimuthDeg = 40, .elevationDeg = 25};
    for (const bool preintegrated : {true, false}) {
      scene.quality.preintegrated = preintegrated;
      if (preintegrated) scene.camera.projection = Projection::kOrthographic;
      const Difference d = beyondReference(scene, source);
      EXPECT_TRUE(d.finite);
      EXPECT_LE(d.largest, kReferenceBound) << name << " " << preintegrated << ", rms " << d.rms;
    }
  }
}

TEST(IsoSurface, KeepsALargestErrorToTheConvergedPicture) {
  ArraySource source = smoothVolume(gridOf({18, 17, 16}));
  for (const char* name : {"alone", "media"}) {
    Scene scene = isoScene(name);
    scene.imageSize = {28, 24};
    scene.quality.maxError = 0.01;
    scene.quality.stepVoxels = 1;  // as the host asks for
    EXPECT_LE(beyondReference(scene, source).largest, *scene.quality.maxError) << name;
  }
}

TEST(IsoSurface, AnyNumberOfBricksDrawsTheSamePicture) {
  const VolumeGrid grid = gridOf({46, 37, 29}, {1.0, 0.8, 1.9});
  ArraySource source = smoothVolume(grid);
  for (const char* name : {"alone", "media"}) {
    Scene scene = isoScene(name);
    scene.camera = {.azimuthDeg = 35, .elevationDeg = 25};
    scene = resolved(scene, source);
    const Camera camera = resolveCamera(scene, {grid, false});
    const Image<Rgba> one = drawAlone(scene, source, camera, {.bricks = 1});
    EXPECT_GT(largestAlpha(one), 0.3);
    const std::vector<double> slack = surfaceSlack(scene, source, camera);
    for (const int bricks : {2, 3, 5, 8, 64}) {
      const Image<Rgba> many = drawAlone(scene, source, camera, {.bricks = bricks});
      const Difference d = differenceBeyond(slack, std::span<const Rgba>{one.pixels()},
                                            std::span<const Rgba>{many.pixels()});
      EXPECT_LE(d.largest, kLargest) << name << ", " << bricks;
      EXPECT_LE(d.rms, kRms) << name << ", " << bricks;
    }
  }
}

TEST(IsoSurface, SkippingChangesNoBitAndSavesSamples) {
  ArraySource source = smoothVolume(gridOf({29, 34, 24}, {1, 1.3, 0.7}));
  const Communicator self{MPI_COMM_SELF};
  for (const char* name : {"alone", "media"}) {
    Scene scene = resolved(isoScene(name), source);
    node::Worker skipping{self, scene, source, {.bricks = 4, .skip = true, .countSamples = true}};
    node::Worker visiting{self, scene, source, {.bricks = 4, .skip = false, .countSamples = true}};
    for (const double value : {0.6, 0.85, 0.3}) {
      scene.layers[0].isoValue = value;
      scene.quality.stepVoxels = value == 0.6 ? 0.5 : 1.7;
      scene.quality.preintegrated = value != 0.3;
      skipping.update(scene);
      visiting.update(scene);
      const Camera camera = resolveCamera(scene, {source.info().grid, false});
      RankStatistics on, off;
      const Image<Rgba> skipped = drawFrame(skipping, scene, camera, on);
      const Image<Rgba> visited = drawFrame(visiting, scene, camera, off);
      EXPECT_TRUE(std::ranges::equal(skipped.pixels(), visited.pixels())) << name << " " << value;
      EXPECT_EQ(on.samplesShaded, off.samplesShaded);
      EXPECT_LT(on.samplesVisited, off.samplesVisited);
    }
  }
}

TEST(IsoSurface, SlicesSayThatTheyDrawMediaOnly) {
  EXPECT_THROW(
      node::checkTechnique(isoScene("media"), node::Technique::kSlices, node::Precision::kFloat),
      Error);
}

}  // namespace
}  // namespace burin::test
