#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "burin/common/error.hpp"
#include "burin/common/scene.hpp"
#include "random_scene.hpp"
#include "scene_text.hpp"

namespace burin {
namespace {

using test::complaint;
using test::with;
using testing::HasSubstr;
using testing::StartsWith;

TEST(SceneError, UnknownKeyNamesPlacePathAndNearest) {
  EXPECT_EQ(complaint(R"({ "schema_version": 1,
  "layers": [{ "transfer_function": { "points": [{ "value": 1, "color": "#fff", "opacity": 1 }] },
               "style": { "tone": { "strengh": 0.5 } } }] })"),
            "s.json:3:37: layers[0].style.tone.strengh: unknown key; did you mean 'strength'?");
  EXPECT_EQ(complaint(with(R"("qualty": {})")),
            "s.json:2:1: qualty: unknown key; did you mean 'quality'?");
  EXPECT_EQ(complaint(with(R"("quality": { "error": 0.1 })")),
            "s.json:2:14: quality.error: unknown key; expected one of 'step_voxels', "
            "'termination', 'preintegrated', 'max_error', 'combine', 'normals', 'palettes'");
}

TEST(SceneError, ColumnsCountCharactersAndTabs) {
  EXPECT_EQ(complaint("{ \"schema_version\": 1, /* ä€ */\t\"x\": 1 }").substr(0, 13),
            "s.json:1:33: ");
  EXPECT_EQ(complaint("\xEF\xBB\xBF{ \"x\": 1 }").substr(0, 12), "s.json:1:3: ");
}

TEST(SceneError, PlaceIsRightAfterEveryKindOfToken) {
  // Comments that look like tokens, strings that look like comments, escapes, and numbers directly
  // before brackets: the offset must follow the parser through all of them.
  const std::string before = R"({ /* " */ "schema_version": 1, // } , "
    "volume": {"file": "a\"//\\\u00e9/*", "dims":[1,2,3]},
    "clip": [{"plane":[-1.5e+0,0,0E1,2]},{"plane":[0,1,0,0]}/**/],)";
  EXPECT_EQ(complaint(before + "\n  \"here\": true }"),
            "s.json:4:3: here: unknown key; expected one of 'schema_version', 'volume', 'labels', "
            "'camera', 'image', 'lights', 'layers', 'clip', 'quality', 'annotations'");
}

TEST(SceneError, Syntax) {
  EXPECT_THAT(complaint("{ \"schema_version\": 1,\n  \"layers\" [] }"),
              StartsWith("s.json:2:12: "));
  EXPECT_THAT(complaint("{ \"schema_version\": 1,\n  \"layers\" [] }"), HasSubstr("syntax error"));
  EXPECT_THAT(complaint(""), StartsWith("s.json:1:1: "));
  EXPECT_THAT(complaint("{"), HasSubstr("unexpected end of input"));
  EXPECT_THAT(complaint("{} x"), StartsWith("s.json:1:4: "));
  EXPECT_THAT(complaint(with(R"("quality": { "step_voxels": 1e999 })")),
              HasSubstr("number overflow"));
  EXPECT_THAT(complaint(with("\"clip\": [\xff]")), StartsWith("s.json:2:10: "));
  EXPECT_THAT(complaint(with("\"clip\": /* open")), HasSubstr("comment"));
  EXPECT_THAT(complaint(std::string(100000, '[')), HasSubstr("nested too deeply"));
}

TEST(SceneError, MessagesStayShortAndOnOneLine) {
  EXPECT_EQ(complaint(with(R"("a\nb": 1)")).substr(0, 32), "s.json:2:1: a b: unknown key; ex");
  EXPECT_THAT(complaint(with("\"camera\": \"" + std::string(1000, 'x') + "\"")),
              testing::EndsWith("found \"" + std::string(60, 'x') + "…\""));
}

TEST(SceneError, DamagedTextEndsInAMessageOrAScene) {
  std::mt19937 random{7};
  const auto below = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>{0, n - 1}(random);
  };
  int accepted = 0;
  std::string whole;
  for (int round = 0; round < 1500; ++round) {
    if (round % 50 == 0) whole = writeScene(test::randomScene(random));
    std::string text = whole;
    for (std::size_t edits = 1 + below(3); edits > 0; --edits) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.erase(at, 1 + below(40));
          break;
        case 2:
          text.insert(at, text.substr(below(text.size()), below(40)));
          break;
        default:
          text.insert(at, 1, "{}[]\",:/*-e9"[below(12)]);
      }
    }
    accepted += complaint(text).empty() ? 1 : 0;  // anything but burin::Error fails the test
  }
  EXPECT_GT(accepted, 0);    // a changed digit
  EXPECT_LT(accepted, 750);  // most damage is noticed
}

TEST(SceneError, KeyThatStandsTwice) {
  EXPECT_EQ(complaint("{ \"schema_version\": 1,\n  \"schema_version\": 1 }"),
            "s.json:2:3: 'schema_version' stands twice in one object");
  EXPECT_EQ(complaint(with("\"image\": {}, \"image\": {}")),
            "s.json:2:14: 'image' stands twice in one object");
}

TEST(SceneError, MissingKeys) {
  EXPECT_EQ(complaint("\n{}"), "s.json:2:1: 'schema_version' is missing");
  EXPECT_EQ(complaint("{ \"schema_version\": 1 }"), "s.json:1:1: 'layers' is missing");
  EXPECT_EQ(complaint(R"({ "schema_version": 1, "layers": [{ "name": "x" }] })"),
            "s.json:1:35: layers[0]: 'transfer_function' is missing");
}

TEST(SceneError, TwoDimensionalTransferFunctions) {
  const auto about = [](const std::string& keys) {
    return complaint(R"({ "schema_version": 1, "layers": [{ "transfer_function":
{)" + keys + "} }] }");
  };
  const auto aboutWidget = [&](const std::string& keys) {
    return about(R"("widgets": [{ "color": "#fff", "opacity": 1, )" + keys + "}]");
  };
  EXPECT_EQ(aboutWidget(R"("shape": "triangle", "value": [0, 1], "apex": 0.5)"), "");
  EXPECT_EQ(aboutWidget(R"("shape": "ellipse", "value": [0, 1], "gradient": [-0.2, 0.2])"), "");
  EXPECT_THAT(about(""), HasSubstr("s.json:2:1: layers[0].transfer_function: expected exactly one "
                                   "of 'points' and 'widgets'"));
  EXPECT_THAT(about(R"("widget": [])"), HasSubstr("did you mean 'widgets'?"));
  EXPECT_THAT(aboutWidget(R"("shape": "triangel", "value": [0, 1])"),
              HasSubstr("'triangel' is unknown; did you mean 'triangle'?"));
  EXPECT_THAT(aboutWidget(R"("shape": "rectangle", "value": [1, 1])"),
              HasSubstr("widgets[0].value: expected rising values"));
  EXPECT_THAT(aboutWidget(R"("shape": "rectangle", "value": [0, 1], "falloff": 1)"),
              HasSubstr("widgets[0].falloff: unknown key"));
  EXPECT_THAT(aboutWidget(R"("shape": "rectangle", "value": [0, 1], "apex": 0.5)"),
              HasSubstr("widgets[0].apex: only a triangle has an apex"));
  EXPECT_THAT(aboutWidget(R"("shape": "ellipse", "value": [0, 1], "value_falloff": 0.5)"),
              HasSubstr("widgets[0].value_falloff: an ellipse falls off from its middle"));
  EXPECT_THAT(aboutWidget(R"("shape": "triangle", "value": [0, 1], "gradient": [0, 1.5])"),
              HasSubstr("widgets[0].gradient: expected numbers in [0, 1]"));
  EXPECT_THAT(complaint(R"({ "schema_version": 1, "layers": [{ "transfer_function":
{ "widgets": [{ "shape": "rectangle", "value": [0, 1], "color": "#fff", "opacity": 1 }] },
"line_opacity": [{ "value": 0, "opacity": 1 }] }] })"),
              HasSubstr("'line_opacity' is by value alone"));
  EXPECT_THAT(complaint(R"({ "schema_version": 1, "layers": [{ "transfer_function":
{ "widgets": [{ "shape": "rectangle", "value": [0, 1], "color": "#fff", "opacity": 1 }] },
"style": { "halo": {} } }] })"),
              HasSubstr("'halo' finds features by value alone"));
  EXPECT_THAT(complaint(R"({ "schema_version": 1, "layers": [{ "transfer_function":
{ "widgets": [{ "shape": "rectangle", "value": [0, 1], "color": "#fff", "opacity": 1 }] },
"mode": "mip" }] })"),
              HasSubstr("mode \"mip\" is by value alone"));
}

TEST(SceneError, OtherVersions) {
  EXPECT_EQ(complaint("{ \"schema_version\": 2 }"),
            "s.json:1:21: schema_version: 2 is unknown; this program reads 1");
  EXPECT_THAT(complaint("{ \"schema_version\": \"1\" }"),
              HasSubstr("expected a number, found \"1\""));
}

struct Case {
  const char* key;
  const char* says;
};

class SceneValueError : public testing::TestWithParam<Case> {};

TEST_P(SceneValueError, IsNamed) {
  const std::string said = complaint(with(GetParam().key));
  EXPECT_THAT(said, StartsWith("s.json:2:"));
  EXPECT_THAT(said, HasSubstr(std::string{": "} + GetParam().says)) << GetParam().key;
}

INSTANTIATE_TEST_SUITE_P(
    Volume, SceneValueError,
    testing::Values(
        Case{R"("volume": {})", "volume: expected exactly one of 'file' and 'procedural'"},
        Case{R"("volume": { "file": "" })",
             "volume: expected exactly one of 'file' and 'procedural'"},
        Case{R"("volume": { "file": "a", "procedural": "b" })", "volume: expected exactly one of"},
        Case{R"("volume": { "procedural": "ramp" })",
             "volume: 'dims' is missing beside 'procedural'"},
        Case{R"("volume": { "procedural": "ramp", "dims": [1, 1, 1], "endian": "big" })",
             "volume.endian: only a raw file has an endianness"},
        Case{R"("volume": { "file": "a", "dims": [4, 0, 4] })",
             "volume.dims[1]: expected a whole number in [1, 1000000], found 0"},
        Case{R"("volume": { "file": "a", "dims": [4, 4.5, 4] })",
             "volume.dims[1]: expected a whole number in [1, 1000000], found 4.5"},
        Case{R"("volume": { "file": "a", "dims": [4, 4] })",
             "volume.dims: expected a list of 3 items, found 2"},
        Case{R"("volume": { "file": "a", "type": "u9" })",
             "volume.type: 'u9' is unknown; did you mean 'u8'?"},
        Case{R"("volume": { "file": "a", "spacing": [1, 1, 0] })",
             "volume.spacing[2]: expected a number greater than 0, found 0"},
        Case{R"("volume": "head.nrrd")", "volume: expected an object, found \"head.nrrd\""}));

INSTANTIATE_TEST_SUITE_P(
    Camera, SceneValueError,
    testing::Values(
        Case{R"("camera": { "view": "front" })",
             "camera.view: 'front' is unknown; expected one of 'anterior'"},
        Case{R"("camera": { "view": "antirior" })",
             "camera.view: 'antirior' is unknown; did you mean 'anterior'?"},
        Case{R"("camera": { "view": "left", "azimuth_deg": 3 })",
             "camera.azimuth_deg: cannot stand beside 'view'"},
        Case{R"("camera": { "eye": [0, 0, 9], "view": "left" })",
             "camera.eye: cannot stand beside 'view'"},
        Case{R"("camera": { "view": "left", "up": "y" })", "camera.up: cannot stand beside 'view'"},
        Case{R"("camera": { "eye": [0, 0, 9], "elevation_deg": 3 })",
             "camera.elevation_deg: cannot stand beside 'eye'"},
        Case{R"("camera": { "target": [0, 0, 9] })", "camera.target: needs 'eye' beside it"},
        Case{R"("camera": { "up": [0, 0, 1] })", "camera.up: a vector needs 'eye' beside it"},
        Case{R"("camera": { "up": "x" })",
             "camera.up: 'x' is unknown; expected one of 'auto', 'y', 'z'"},
        Case{R"("camera": { "eye": [0, 0, 9], "up": [0, 0, 0] })",
             "camera.up: a zero vector has no direction"},
        Case{R"("camera": { "eye": [1, 2, 3], "target": [1, 2, 3] })",
             "camera: 'target' equals 'eye'"},
        Case{R"("camera": { "vertical_fov_deg": 180 })",
             "camera.vertical_fov_deg: expected a number in (0, 180), found 180"},
        Case{R"("camera": { "vertical_fov_deg": 0 })",
             "camera.vertical_fov_deg: expected a number in (0, 180), found 0"},
        Case{R"("camera": { "elevation_deg": 181 })",
             "camera.elevation_deg: expected a number in [-180, 180], found 181"},
        Case{R"("camera": { "zoom": 0 })",
             "camera.zoom: expected a number greater than 0, found 0"},
        Case{R"("camera": { "azimuth_deg": "30" })",
             "camera.azimuth_deg: expected a number, found \"30\""},
        Case{R"("camera": { "azimuth_deg": true })",
             "camera.azimuth_deg: expected a number, found true"},
        Case{R"("camera": { "projection": "parallel" })",
             "camera.projection: 'parallel' is unknown; expected"}));

INSTANTIATE_TEST_SUITE_P(
    Picture, SceneValueError,
    testing::Values(
        Case{R"("image": { "size": [0, 8] })",
             "image.size[0]: expected a whole number in [1, 16384], found 0"},
        Case{R"("image": { "size": [8, 16385] })",
             "image.size[1]: expected a whole number in [1, 16384], found 16385"},
        Case{R"("image": { "size": 512 })", "image.size: expected a list of 2 items, found 512"},
        Case{R"("image": { "background": "white" })",
             "image.background: 'white' is no colour: expected \"#rrggbb\""},
        Case{R"("image": { "background": null })", "image.background: expected text, found null"},
        Case{R"("lights": [])", "lights: expected a list of 1 to 16 items, found 0"},
        Case{R"("lights": {})", "lights: expected a list of 1 to 16 items, found an object"},
        Case{R"("lights": [{ "direction": [0, 0, 0] }])",
             "lights[0].direction: a zero vector has no direction"},
        Case{R"("lights": [{ "space": "camera" }])",
             "lights[0].space: 'camera' is unknown; expected one of 'eye'"},
        Case{R"("lights": [{}, { "color": "#12" }])", "lights[1].color: '#12' is no colour"},
        Case{R"("lights": [{ "intensity": -1 }])",
             "lights[0].intensity: expected a number in [0, 100], found -1"},
        Case{R"("clip": [{ "plane": [1, 2, 3] }])",
             "clip[0].plane: expected a list of 4 items, found 3"},
        Case{R"("clip": [{ "plane": [0, 0, 0, 3] }])",
             "clip[0].plane: a zero normal has no direction"},
        Case{R"("clip": [{}])", "clip[0]: expected exactly one of 'plane' and 'box'"},
        Case{R"("quality": { "step_voxels": 0 })",
             "quality.step_voxels: expected a number in [0.001, 100], found 0"},
        Case{R"("quality": { "termination": 0.6 })",
             "quality.termination: expected a number in [0, 0.5], found 0.6"},
        Case{R"("quality": { "max_error": 0.01, "step_voxels": 1 })",
             "quality: 'max_error' chooses 'step_voxels' itself: give one of the two"},
        Case{R"("quality": { "combine": "ovr" })",
             "quality.combine: 'ovr' is unknown; did you mean 'over'?"},
        Case{R"("quality": { "max_error": 0.01, "combine": "over" })",
             "quality: 'max_error' is the distance to what 'combine' \"sum\" converges to"},
        Case{R"("quality": { "palettes": "before" })",
             "quality: 'palettes' \"before\" classifies voxels, not what lies between values: "
             "expected 'preintegrated' false"},
        Case{R"("quality": { "max_error": 0.01, "normals": "quantised" })",
             "quality: 'max_error' is the distance to exact 'normals' and 'palettes' \"after\" "
             "filtering"},
        Case{R"("quality": { "preintegrated": 1 })",
             "quality.preintegrated: expected true or false, found 1"}));

/// A scene with one layer, whose second line is its transfer function's points and style.
std::string layer(const std::string& points, const std::string& style = "{}") {
  return "{ \"schema_version\": 1, \"layers\": [{ \"transfer_function\": { \"points\": \n" +
         points + "\n}, \"style\":\n" + style + " }] }";
}
const std::string kPoint = R"([{ "value": 1, "color": "#fff", "opacity": 1 }])";

TEST(SceneError, TransferFunctions) {
  EXPECT_EQ(complaint(layer("[]")),
            "s.json:2:1: layers[0].transfer_function.points: expected a list of 1 to 4096 items, "
            "found 0");
  EXPECT_EQ(
      complaint(layer(
          R"([{ "value": 5, "color": "#fff", "opacity": 1 }, { "value": 4, "color": "#fff", "opacity": 1 }])")),
      "s.json:2:49: layers[0].transfer_function.points[1]: value 4 is below 5 of the point before; "
      "expected rising values");
  EXPECT_EQ(complaint(layer(R"([{ "value": 5, "color": "#fff", "opacity": 1.5 }])")),
            "s.json:2:44: layers[0].transfer_function.points[0].opacity: expected a number in [0, "
            "1], found 1.5");
  EXPECT_EQ(complaint(layer(R"([{ "value": 5, "opacity": 1 }])")),
            "s.json:2:2: layers[0].transfer_function.points[0]: 'color' is missing");
  const std::string p = R"({ "value": 5, "color": "#fff", "opacity": 1 })";
  EXPECT_EQ(complaint(layer("[" + p + "," + p + "]")), "");
  EXPECT_THAT(complaint(layer("[" + p + "," + p + "," + p + "]")),
              HasSubstr("points[2]: third point at value 5; two make a step"));
}

TEST(SceneError, StyleParameters) {
  EXPECT_EQ(complaint(layer(kPoint, R"({ "tome": {} })")),
            "s.json:4:3: layers[0].style.tome: unknown key; did you mean 'tone'?");
  EXPECT_THAT(complaint(layer(kPoint, R"({ "edges": { "colour": "#000" } })")),
              HasSubstr("layers[0].style.edges.colour: unknown key; did you mean 'color'?"));
  EXPECT_EQ(complaint(layer(kPoint, R"({ "tone": { "strength": 1.5 } })")),
            "s.json:4:25: layers[0].style.tone.strength: expected a number in [0, 1], found 1.5");
  EXPECT_THAT(complaint(layer(kPoint, R"({ "tone": { "mode": "goch" } })")),
              HasSubstr("layers[0].style.tone.mode: 'goch' is unknown; did you mean 'gooch'?"));
  EXPECT_THAT(complaint(layer(kPoint, R"({ "tone": { "warm": "#12345" } })")),
              HasSubstr("layers[0].style.tone.warm: '#12345' is no colour"));
  EXPECT_THAT(complaint(layer(kPoint, R"({ "tone": true })")),
              HasSubstr("layers[0].style.tone: expected an object, found true"));
}

TEST(SceneError, Curves) {
  const auto curve = [](const std::string& text) {
    return complaint(layer(kPoint, R"({ "surface": { "opacity": )" + text + " } }"));
  };
  EXPECT_EQ(curve("[[0, 0], [1, 4]]"), "");
  EXPECT_THAT(curve("[]"), HasSubstr("surface.opacity: expected a list of 1 to 64 items, found 0"));
  EXPECT_THAT(curve("[[0, 0], [1]]"),
              HasSubstr("surface.opacity[1]: expected a list of 2 items, found 1"));
  EXPECT_THAT(curve("[[0, 0], [1, 4.5]]"),
              HasSubstr("surface.opacity[1][1]: expected a number in [0, 4], found 4.5"));
  EXPECT_THAT(curve("[[0.5, 0], [0.5, 1]]"),
              HasSubstr("surface.opacity[1]: 0.5 does not grow over 0.5 of the point before"));
}

}  // namespace
}  // namespace burin
