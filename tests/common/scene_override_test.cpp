#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "burin/common/scene.hpp"
#include "scene_text.hpp"

namespace burin {
namespace {

using test::complaint;
using test::with;
using testing::StartsWith;

TEST(SceneOverride, ChangesAddsAppendsAndRemoves) {
  const std::string base = with(R"("camera": { "azimuth_deg": 10 })");
  const Scene scene =
      parseScene(base, "s.json",
                 {"layers.0.style.tone.strength=0.5", "camera.azimuth_deg=null", "camera.view=left",
                  "layers[0].name=bone", "image.size=[64,48]", "image.background=#102030",
                  "clip.0.plane=[1,0,0,2]", "quality.termination=0"});
  EXPECT_EQ(scene.layers[0].style("tone")->number("strength"), 0.5);
  EXPECT_EQ(scene.camera.view, "left");
  EXPECT_EQ(scene.layers[0].name, "bone");
  EXPECT_EQ(scene.imageSize, (ImageSize{64, 48}));
  EXPECT_EQ(scene.background, (Colour{0x10, 0x20, 0x30}));
  EXPECT_EQ(scene.clip.at(0), (ClipPlane{{1, 0, 0}, 2}));
  EXPECT_EQ(scene.quality.termination, 0);
}

TEST(SceneOverride, ReplacesWhatCannotStandBesideIt) {
  const std::string orbit = with(
      R"("camera": { "azimuth_deg": 10, "elevation_deg": 5, "up": "z" }, "quality": { "step_voxels": 2, "termination": 0 })");
  const Scene viewed = parseScene(orbit, "s.json", {"camera.view=anterior"});
  EXPECT_EQ(viewed.camera.view, "anterior");
  const Scene error = parseScene(orbit, "s.json", {"quality.max_error=0.01"});
  EXPECT_EQ(error.quality.maxError, 0.01);
  const Scene step =
      parseScene(with(R"("quality": { "max_error": 0.01 })"), "s.json", {"quality.step_voxels=2"});
  EXPECT_FALSE(step.quality.maxError);
  EXPECT_EQ(step.quality.stepVoxels, 2);
  const Scene turned = parseScene(with(R"("camera": { "eye": [9, 9, 9], "target": [1, 2, 3] })"),
                                  "s.json", {"camera.azimuth_deg=40"});
  EXPECT_FALSE(turned.camera.eye);
  EXPECT_EQ(turned.camera.azimuthDeg, 40);
  // But not what was said beside it.
  EXPECT_THAT(complaint(orbit, {"camera.azimuth_deg=3", "camera.view=left"}),
              testing::HasSubstr("cannot stand beside 'view'"));
}

TEST(SceneOverride, StylesByNameLeaveTheLayerItsGradients) {
  const auto styled = [](const char* style) {
    return fmt::format(
        R"({{ "schema_version": 1, "layers": [{{ "transfer_function": {{ "points": [
            {{ "value": 1, "color": "#fff", "opacity": 1 }}] }}, "style": {} }}] }})",
        style);
  };
  const std::string own = styled(R"({ "gradient": { "noise_floor": 0.1 }, "light": {} })");
  const Scene toon = parseScene(own, "s.json", {"layers.0.style=toon"});
  EXPECT_NE(toon.layers[0].style("edges"), nullptr);  // of that style
  EXPECT_EQ(toon.layers[0].style("gradient")->number("noise_floor"), 0.1);
  // Sobel, of that style.
  const Scene carved = parseScene(own, "s.json", {"layers.0.style=carved"});
  EXPECT_EQ(carved.layers[0].style("gradient")->word("operator"), "sobel");
  EXPECT_NE(carved.layers[0].style("gradient")->number("noise_floor"), 0.1);
  // Projections see nothing of what styles go by.
  const Scene mip = parseScene(own, "s.json", {"layers.0.mode=mip"});
  EXPECT_TRUE(mip.layers[0].styles.empty());
}

TEST(SceneOverride, LaterOnesWin) {
  const Scene scene =
      parseScene(with("\"camera\": {}"), "s.json", {"camera.zoom=2", "camera.zoom=3"});
  EXPECT_EQ(scene.camera.zoom, 3);
}

TEST(SceneOverride, MessagesNameTheOverride) {
  const std::string base = with("\"camera\": {}");
  const auto says = [&](const std::string& text) { return complaint(base, {text}); };
  EXPECT_EQ(
      says("layers.0.style.tone.strengh=0.5"),
      "--set layers.0.style.tone.strengh=0.5: layers[0].style.tone.strengh: unknown key; did you "
      "mean 'strength'?");
  EXPECT_EQ(says("camera.zoom=-1"),
            "--set camera.zoom=-1: camera.zoom: expected a number greater than 0, found -1");
  EXPECT_EQ(says("camera.zoom=big"),
            "--set camera.zoom=big: camera.zoom: expected a number greater than 0, found \"big\"");
  EXPECT_EQ(says("camera.zoom"),
            "--set camera.zoom: expected path=value, such as layers.0.style.tone.strength=0.5");
  EXPECT_EQ(says("layers.2.name=x"),
            "--set layers.2.name=x: layers: '2' is no item of a list of 1");
  EXPECT_EQ(says("layers.bone.name=x"),
            "--set layers.bone.name=x: layers: 'bone' is no item of a list of 1");
  EXPECT_EQ(says("schema_version.x=1"),
            "--set schema_version.x=1: schema_version: is 1, which has no 'x'");
  EXPECT_THAT(says("image.size=[64,"), StartsWith("--set image.size=[64,:1:"));
  EXPECT_THAT(says("layers.1.name=x"),
              testing::StrEq("--set layers.1.name=x: layers[1]: 'transfer_function' is missing"));
}

}  // namespace
}  // namespace burin
