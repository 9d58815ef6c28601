#include "bench/rate_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace burin::host::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

RateMeasurement row(std::string scene, Look look, double ratio, std::int64_t shaded) {
  RateMeasurement measured;
  measured.scene = std::move(scene);
  measured.look = look;
  measured.repeats = 5;
  measured.ratio = ratio;
  measured.frame = {1050, shaded, 1000, 7, 64, 2, 1, 4};
  measured.busy = {6400, 6400, 6400, 0, 64, 8, 7, 9};
  return measured;
}

TEST(RateTable, CsvHasALineForEachMeasurement) {
  const std::vector rows{row("head", Look::kOpaque, 0.5, 350)};
  const std::string csv = rateCsv(rows);
  EXPECT_THAT(csv, StartsWith("scene,look,style,ratio,median_ms,samples_visited,"));
  EXPECT_THAT(csv, HasSubstr("\nhead,opaque,plain,0.50000,2.0000,1050,350,1000,7,5.25e+05,1.0000,"
                             "4.0000,8.0000,6400,6400,64,8e+05,7.0000,9.0000,5\n"));
}

// The worst of each look counts, frames that show nothing do not.
TEST(RateTable, TargetsAreThoseOfTheLook) {
  const std::vector rows{row("a", Look::kOpaque, 0.5, 350), row("b", Look::kOpaque, 0.26, 250),
                         row("c", Look::kOpaque, 0.1, 0), row("a", Look::kTranslucent, 0.69, 700)};
  const std::string text = rateTargets(rows);
  EXPECT_THAT(text, HasSubstr("0.2600   target 0.25  met"));
  EXPECT_THAT(text, HasSubstr("4.2000   target 3.5   missed"));
  EXPECT_THAT(text, HasSubstr("0.6900   target 0.7   missed"));
  EXPECT_THAT(text, HasSubstr("1.5000   target 1.7   met"));
  EXPECT_THAT(text, HasSubstr("1.0500   target 1.05  met"));
}

TEST(RateTable, LooksThatWereNotMeasuredHaveNoTargets) {
  const std::vector rows{row("a", Look::kOpaque, 0.5, 350)};
  EXPECT_THAT(rateTargets(rows), Not(HasSubstr("translucent")));
}

// Every ray of the busy frame meets the volume's whole depth: its face fills the frame, and little
// of it is left out.
TEST(RateScenes, TheFaceFillsTheFrame) {
  for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
    VolumeFacts facts;
    facts.grid.dims = {41, 21, 61};
    facts.grid.origin = {3, -70, 12};
    facts.grid.spacing = {1, 1.5, 0.5};
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].transferFunction = {{{0, {}, 0}, {1, {}, 0.5}}, {}};
    scene.imageSize = {200, 150};
    scene.camera.projection = projection;
    scene.clip = {{{0, 0, 2}, 1e3}};
    resolveScene(scene, facts);
    const Scene busy = withAllLanesBusy(scene, facts);
    const Camera camera = resolveCamera(busy, facts);
    ASSERT_EQ(camera.projection, Projection::kOrthographic);
    EXPECT_NEAR(std::abs(camera.forward.z), 1, 1e-12);
    const glm::dvec3 centre = facts.grid.centreWorld();
    const double halfWidth = 0.5 * camera.image.width * camera.pixelSize;
    const double halfHeight = 0.5 * camera.image.height * camera.pixelSize;
    EXPECT_NEAR(camera.eyeWorld.x, centre.x, 1e-9);
    EXPECT_NEAR(camera.eyeWorld.y, centre.y, 1e-9);
    EXPECT_LE(halfWidth, 20 + 1e-9);
    EXPECT_GT(halfWidth, 20 - camera.pixelSize);
    EXPECT_LE(halfHeight, 15 + 1e-9);
    EXPECT_GT(halfHeight, 15 - camera.pixelSize);
    EXPECT_EQ(busy.quality.termination, 0);
    for (const TransferPoint& point : busy.layers[0].transferFunction.points)
      EXPECT_GT(point.opacity, 0);
    const ClipPlane& plane = busy.clip.at(0);
    for (const glm::dvec3 corner :
         {facts.grid.worldFromIndex({0, 0, 0}), facts.grid.worldFromIndex(facts.grid.dims - 1)})
      EXPECT_GT(glm::dot(plane.normal, corner) + plane.offset, 0);
  }
}

TEST(RateScenes, WaysOfDrawing) {
  Scene scene;
  scene.layers.resize(2);
  for (Layer& layer : scene.layers) {
    layer.transferFunction = {{{0, {}, 0}, {1, {}, 0.5}}, {}};
    layer.styles = {defaultSettings(*findStyle("light"))};
  }
  const Scene plain = drawnAs(scene, Look::kOpaque, Shading::kPlain);
  const Scene styled = drawnAs(scene, Look::kTranslucent, Shading::kToneEdges);
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_TRUE(plain.layers[i].styles.empty());
    EXPECT_EQ(plain.layers[i].transferFunction, scene.layers[i].transferFunction);
    EXPECT_NE(styled.layers[i].style("tone"), nullptr);
    EXPECT_NE(styled.layers[i].style("edges"), nullptr);
    EXPECT_EQ(styled.layers[i].style("light"), nullptr);
    EXPECT_DOUBLE_EQ(styled.layers[i].transferFunction.points[1].opacity, 0.015);
  }
}

}  // namespace
}  // namespace burin::host::bench
