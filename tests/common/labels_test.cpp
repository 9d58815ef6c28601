#include "burin/common/labels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "burin/common/error.hpp"
#include "scene_text.hpp"

namespace burin {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// As ITK-SNAP writes them, with what people add by hand.
constexpr const char* kDescriptions =
    "################################################\n"
    "# ITK-SnAP Label Description File\r\n"
    "# IDX   -R-  -G-  -B-  -A--  VIS MSH  LABEL\n"
    "    0     0    0    0        0  0  0    \"Clear Label\"\n"
    "    1   255    0   16        1  1  1    \"Label 1\"\r\n"
    "\n"
    "\t17  10  20.4  30  0.5  1  0 \"the \"left\" one\"";

TEST(LabelDescriptions, NumberNameAndColour) {
  EXPECT_THAT(parseLabelDescriptions(kDescriptions, "l.txt"),
              ElementsAre(LabelInfo{0, "Clear Label", Colour{0, 0, 0}},
                          LabelInfo{1, "Label 1", Colour{255, 0, 16}},
                          LabelInfo{17, "the \"left\" one", Colour{10, 20, 30}}));
  EXPECT_TRUE(parseLabelDescriptions("", "l.txt").empty());
}

TEST(LabelDescriptions, WhatIsNoneIsRefusedByItsLine) {
  for (const char* line :
       {"1 255 0 0 1 1 1", "1 256 0 0 1 1 1 \"a\"", "1 255 0 0 1 1 \"a\"", "x 0 0 0 1 1 1 \"a\"",
        "1.5 0 0 0 1 1 1 \"a\"", "1 0 0 0 1 1 1 \"a", "-99999999 0 0 0 1 1 1 \"a\""}) {
    try {
      parseLabelDescriptions(std::string{"# one\n"} + line, "l.txt");
      ADD_FAILURE() << line;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage);
      EXPECT_THAT(error.what(), testing::StartsWith("l.txt:2: ")) << line;
    }
  }
}

TEST(LabelNames, BecomeNumbers) {
  Scene scene;
  scene.layers.resize(2);
  scene.layers[1].labels = {"liver", 7, "spleen"};
  const std::vector<LabelInfo> known{{3, "spleen", {}}, {5, "liver", {}}};
  resolveLabels(scene, known, "seg.nrrd");
  EXPECT_EQ(scene.layers[1].labels, (std::vector<LabelName>{5, 7, 3}));
  EXPECT_TRUE(scene.layers[0].labels.empty());
  const auto complaint = [&](const std::vector<LabelInfo>& labels) -> std::string {
    scene.layers[1].labels = {"livr"};
    try {
      resolveLabels(scene, labels, "seg.nrrd");
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage);
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint(known),
            "layers[1].labels: seg.nrrd has no label 'livr'; did you mean 'liver'?");
  EXPECT_THAT(complaint({}), HasSubstr("it names none"));
}

TEST(LabelKeys, AFileAloneOrWithWhatItTakes) {
  const std::string layer =
      R"("layers": [{ "transfer_function": { "points": [{ "value": 1, "color": "#fff", "opacity": 1 }] },
                      "labels": [0, "liver"] }] })";
  const Scene alone =
      parseScene("{ \"schema_version\": 1, \"labels\": \"seg.nrrd\", " + layer, "s.json");
  EXPECT_EQ(alone.labels.file, "seg.nrrd");
  EXPECT_EQ(alone.layers[0].labels, (std::vector<LabelName>{0, "liver"}));
  const Scene whole = parseScene(
      R"({ "schema_version": 1, "labels": { "file": "a/seg.nii", "component": 1, "names": "n.txt" }, )" +
          layer,
      "s.json");
  EXPECT_EQ(whole.labels.component, 1);
  EXPECT_EQ(whole.labels.names, "n.txt");
  Scene moved = whole;
  setSceneFolder(moved, "there");
  EXPECT_EQ(moved.labels.file, "there/a/seg.nii");
  EXPECT_EQ(moved.labels.names, "there/n.txt");
  EXPECT_EQ(moved.volume.file, "");
  EXPECT_THAT(test::complaint(test::with(R"("labels": { "names": "n.txt" })")),
              HasSubstr("expected exactly one of 'file' and 'procedural'"));
  EXPECT_THAT(test::complaint(test::with(R"("labels": "")")), HasSubstr("the name of a file"));
}

}  // namespace
}  // namespace burin
