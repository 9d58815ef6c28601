#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "burin/common/error.hpp"
#include "burin/common/scene.hpp"
#include "random_scene.hpp"

namespace burin {
namespace {

TEST(SceneRoundTrip, RandomScenesComeBackExactly) {
  std::mt19937 random{42};
  for (int i = 0; i < 150; ++i) {
    const Scene scene = test::randomScene(random);
    const std::string text = writeScene(scene);
    ASSERT_EQ(parseScene(text, "round trip"), scene) << text;
    ASSERT_EQ(writeScene(parseScene(text, "round trip")), text);
  }
}

constexpr const char* kMinimal = R"({
  "schema_version": 1,
  "layers": [{ "transfer_function": { "points": [{ "value": 1, "color": "#fff", "opacity": 0.5 }] } }]
})";

TEST(SceneRoundTrip, AbsentKeysHaveTheContractsDefaults) {
  const Scene scene = parseScene(kMinimal, "minimal");
  Scene expected;
  expected.layers.resize(1);
  expected.layers[0].transferFunction.points = {{1, Colour{255, 255, 255}, 0.5}};
  EXPECT_EQ(scene, expected);
  EXPECT_EQ(scene.quality.stepVoxels, 0.5);
  EXPECT_EQ(scene.quality.termination, 0.002);
  EXPECT_EQ(scene.camera.upAxis, "auto");
  EXPECT_EQ(scene.imageSize, (ImageSize{1024, 1024}));
  EXPECT_EQ(scene.background, (Colour{255, 255, 255}));
  EXPECT_EQ(parseScene(writeScene(scene), "round trip"), scene);
}

TEST(SceneRoundTrip, ReadsTheContractsExample) {
  const Scene scene = parseScene(R"(// a head
    { "schema_version": 1,
      "volume": { "file": "head.nrrd" }, /* relative */
      "camera": { "azimuth_deg": 30, "elevation_deg": 20, "vertical_fov_deg": 30, "zoom": 1 },
      "image":  { "size": [1024, 768], "background": "transparent" },
      "lights": [ { "direction": [0.3, 0.4, 0.86], "space": "eye" } ],
      "layers": [ { "name": "bone",
                    "transfer_function": { "points": [ { "value": 300, "color": "#e8dcc0", "opacity": 0 },
                                                       { "value": 700, "color": "#fff7e6", "opacity": 0.9 } ],
                                           "opacity_unit_length": 1.0 },
                    "style": { "tone": {}, "edges": { "threshold": 0.25 } } } ],
      "clip": [ { "plane": [1,0,0,-20] } ],
      "quality": { "step_voxels": 0.5, "termination": 0.002 } })",
                                 "example");
  EXPECT_EQ(scene.volume.file, "head.nrrd");
  EXPECT_EQ(scene.imageSize, (ImageSize{1024, 768}));
  EXPECT_FALSE(scene.background.has_value());
  EXPECT_EQ(scene.layers[0].transferFunction.points[1].colour, (Colour{0xff, 0xf7, 0xe6}));
  EXPECT_EQ(scene.clip[0], (ClipPlane{{1, 0, 0}, -20}));
  EXPECT_EQ(*scene.layers[0].style("tone"), defaultSettings(*findStyle("tone")));
  EXPECT_EQ(scene.layers[0].style("edges")->number("threshold"), 0.25);
  EXPECT_EQ(scene.layers[0].style("edges")->number("strength"), 1);
  EXPECT_EQ(scene.layers[0].style("specular"), nullptr);
}

TEST(SceneRoundTrip, ClipBoxAmongPlanes) {
  const Scene scene = parseScene(
      kMinimal, "minimal",
      {R"(clip=[{"box": {"min": [1, 2, 3], "max": [4, 5, 6]}, "cap": false}, {"plane": [0, 0, 1, 2]}])"});
  ASSERT_EQ(scene.clip.size(), 1u);
  EXPECT_EQ(scene.clip[0], (ClipPlane{{0, 0, 1}, 2, true}));
  EXPECT_EQ(scene.clipBox, (ClipBox{{1, 2, 3}, {4, 5, 6}, false}));
  EXPECT_EQ(parseScene(writeScene(scene), "again"), scene);
}

TEST(SceneRoundTrip, StylesStandInTheTablesOrder) {
  Scene scene = parseScene(kMinimal, "minimal",
                           {"layers.0.style={\"specular\": {}, \"light\": {}, \"tone\": {}}"});
  std::vector<std::string> names;
  for (const StyleSettings& style : scene.layers[0].styles) names.push_back(style.name);
  EXPECT_THAT(names, testing::ElementsAre("light", "tone", "specular"));
}

TEST(WriteScene, IsForPeople) {
  Scene scene = parseScene(kMinimal, "minimal");
  scene.layers[0].transferFunction.points.push_back({300, Colour{0xe8, 0xdc, 0xc0}, 0.1});
  const std::string text = writeScene(scene);
  EXPECT_THAT(text, testing::StartsWith("{\n  \"schema_version\": 1,\n"));
  EXPECT_THAT(text,
              testing::HasSubstr(
                  "\n          { \"value\": 300, \"color\": \"#e8dcc0\", \"opacity\": 0.1 }\n"));
  EXPECT_THAT(text, testing::HasSubstr(
                        "\"image\": { \"size\": [1024, 1024], \"background\": \"#ffffff\" }"));
  EXPECT_THAT(text, testing::EndsWith("}\n"));
  std::istringstream lines{text};
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(WriteScene, TextThatIsNotUtf8DoesNotStopIt) {
  Scene scene = parseScene(kMinimal, "minimal");
  scene.volume.file = "caf\xe9.nrrd";
  EXPECT_THAT(writeScene(scene), testing::HasSubstr("caf\xEF\xBF\xBD.nrrd"));
}

class LoadScene : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("burin_load_scene_" + std::to_string(std::random_device{}()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& text) {
    const auto file = folder_ / "scene.json";
    std::ofstream{file} << text;
    return file;
  }
  std::filesystem::path folder_;
};

TEST_F(LoadScene, VolumeIsRelativeToTheScene) {
  const auto file = write(kMinimal);
  EXPECT_EQ(loadScene(file, {"volume.file=data/../a.nrrd"}).volume.file,
            (folder_ / "a.nrrd").string());
  EXPECT_EQ(loadScene(file, {"volume.file=/b/a.nrrd"}).volume.file, "/b/a.nrrd");
  EXPECT_EQ(loadScene(file).volume.file, "");
}

TEST_F(LoadScene, NamesWhatCannotBeRead) {
  const auto message = [](const std::filesystem::path& file) -> std::string {
    try {
      loadScene(file);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage);
      return error.what();
    }
    return "";
  };
  const auto missing = folder_ / "missing.json";
  EXPECT_EQ(message(missing),
            missing.string() + ": cannot read the scene: No such file or directory");
  EXPECT_THAT(message(folder_), testing::StartsWith(folder_.string() + ": cannot read the scene"));
  const auto huge = folder_ / "huge.nrrd";
  std::ofstream{huge} << "NRRD0004\n";
  std::filesystem::resize_file(huge, std::uintmax_t{1} << 32);  // sparse: no disk is used
  EXPECT_THAT(message(huge), testing::HasSubstr("4294967296 bytes, too many for the scene"));
  EXPECT_THAT(message(write("{")), testing::StartsWith((folder_ / "scene.json").string() + ":1:"));
}

}  // namespace
}  // namespace burin
