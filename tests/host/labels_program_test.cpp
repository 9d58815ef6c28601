// Segmentations as users give them to the program.
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "burin/common/scene.hpp"
#include "host/program.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

using test::onlyLine;
using test::runBurin;
using testing::HasSubstr;

constexpr const char* kNames =
    "1 200 150 120 1 1 1 \"soft tissue\"\n2 250 240 220 1 1 1 \"bone\"\n"
    "5 250 0 0 1 1 1 \"lesion\"\n";

class Labels : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new test::TemporaryFolder;
    make("ct-phantom", "24,24,24", "i16", "head.nrrd");
    make("ct-phantom-labels", "24,24,24", "u8", "seg.nii");
    folder_->write("names.txt", kNames);
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string path(const char* name) { return *folder_ / name; }

  static void make(const char* kind, const char* dims, const char* type, const char* file) {
    const auto made =
        runBurin({"make-volume", kind, "--dims", dims, "--type", type, "-o", path(file)});
    ASSERT_EQ(made.exitCode, 0) << made.err;
  }

  /// `burin render` with those arguments behind the output and the size.
  test::ProgramResult render(const char* output, std::vector<std::string> arguments,
                             int ranks = 0) {
    arguments.insert(arguments.begin(),
                     {"render", "-o", path(output), "--size", "48x40", "--quiet"});
    return runBurin(arguments, ranks);
  }

  std::vector<float> pixels(const char* file) {
    const auto in = OIIO::ImageInput::open(path(file));
    if (!in) throw std::runtime_error{OIIO::geterror()};
    std::vector<float> values(in->spec().image_pixels() *
                              static_cast<std::size_t>(in->spec().nchannels));
    EXPECT_TRUE(
        in->read_image(0, 0, 0, in->spec().nchannels, OIIO::TypeDesc::FLOAT, values.data()));
    return values;
  }

  double largestDifference(const char* a, const char* b) {
    const std::vector<float> p = pixels(a), q = pixels(b);
    EXPECT_EQ(p.size(), q.size());
    EXPECT_GT(*std::ranges::max_element(p), 0.1f) << "an empty picture proves nothing";
    double largest = 0;
    for (std::size_t i = 0; i < std::min(p.size(), q.size()); ++i)
      largest = std::max(largest, std::abs(double{p[i]} - double{q[i]}));
    return largest;
  }

  static inline const test::TemporaryFolder* folder_ = nullptr;
};

TEST_F(Labels, WithoutASceneEachIsALayer) {
  std::filesystem::create_directory(path("sub"));
  const std::vector<std::string> given{path("head.nrrd"),      "--labels",        path("seg.nii"),
                                       "--label-names",        path("names.txt"), "--set",
                                       "quality.termination=0"};
  std::vector<std::string> saving = given;
  saving.insert(saving.end(), {"--save-scene", path("sub/s.json")});
  ASSERT_EQ(render("a.exr", saving).exitCode, 0);
  const Scene scene = loadScene(path("sub/s.json"));
  ASSERT_EQ(scene.layers.size(), 6u);
  const auto lesion = std::ranges::find(scene.layers, "lesion", &Layer::name);
  ASSERT_NE(lesion, scene.layers.end());
  EXPECT_EQ(lesion->labels, std::vector<LabelName>{5});
  EXPECT_EQ(lesion->transferFunction.points[0].colour, (Colour{250, 0, 0}));
  EXPECT_EQ(std::ranges::count(scene.layers, "label 3", &Layer::name), 1);
  ASSERT_EQ(render("b.exr", {path("sub/s.json")}).exitCode, 0);
  EXPECT_EQ(pixels("a.exr"), pixels("b.exr"));
  ASSERT_EQ(render("c.exr", given, 3).exitCode, 0);
  EXPECT_LE(largestDifference("a.exr", "c.exr"), 5e-5);  // as of rank_invariance_test.cpp
  ASSERT_EQ(render("d.exr", {path("sub/s.json"), "--reference"}).exitCode, 0);
  EXPECT_LE(largestDifference("a.exr", "d.exr"), 1e-4);  // kReferenceBound of the node's tests
}

TEST_F(Labels, NamesChooseThemInAScene) {
  folder_->write("s.json", R"({ "schema_version": 1, "volume": { "file": "head.nrrd" },
    "labels": { "file": "seg.nii", "names": "names.txt" },
    "layers": [{ "labels": ["bone"], "transfer_function": { "points": [
      { "value": 0, "color": "#fff", "opacity": 0.3 }] } }] })");
  ASSERT_EQ(render("a.exr", {path("s.json")}).exitCode, 0);
  ASSERT_EQ(render("b.exr", {path("s.json"), "--set", "layers.0.labels=[2]"}).exitCode, 0);
  EXPECT_EQ(pixels("a.exr"), pixels("b.exr"));
  const auto wrong = render("c.exr", {path("s.json"), "--set", "layers.0.labels=[\"bonne\"]"});
  EXPECT_EQ(wrong.exitCode, 2);
  EXPECT_THAT(onlyLine(wrong.err), HasSubstr("did you mean 'bone'?"));
}

TEST_F(Labels, InfoListsThem) {
  const auto info = runBurin({"info", path("seg.nii"), "--label-names", path("names.txt")});
  EXPECT_EQ(info.exitCode, 0) << info.err;
  EXPECT_THAT(info.out, HasSubstr("label        5 \"lesion\" #fa0000, "));
}

TEST_F(Labels, WhatCannotBeUsedIsSaidInOneLine) {
  make("ct-phantom-labels", "24,24,23", "u8", "short.nii");
  make("ct-phantom", "24,24,24", "f32", "real.nii");
  folder_->write("bound.json", R"({ "schema_version": 1, "volume": { "file": "head.nrrd" },
    "layers": [{ "labels": [2], "transfer_function": { "points": [
      { "value": 0, "color": "#fff", "opacity": 0.3 }] } }] })");
  struct Wrong {
    const char* input;
    const char* labels;
    int exitCode;
    std::vector<int> ranks;
    std::vector<const char*> words;
  };
  for (const Wrong& wrong :
       {Wrong{"head.nrrd",
              "short.nii",
              3,
              {0, 3},
              {"head.nrrd", "short.nii", "24 x 24 x 24 and 24 x 24 x 23 voxels"}},
        Wrong{"head.nrrd", "none.nii", 3, {3}, {"none.nii"}},
        Wrong{"head.nrrd", "real.nii", 3, {3}, {"real.nii", "is no label"}},
        Wrong{"bound.json", "", 2, {0}, {"layers[0].labels: there is no label volume"}}}) {
    for (const int ranks : wrong.ranks) {
      std::vector<std::string> arguments{path(wrong.input)};
      if (*wrong.labels != '\0') {
        arguments.emplace_back("--labels");
        arguments.push_back(path(wrong.labels));
      }
      const auto result = render("no.exr", arguments, ranks);
      EXPECT_EQ(result.exitCode, wrong.exitCode) << result.err;
      const std::string line = onlyLine(result.err);
      for (const char* word : wrong.words) EXPECT_THAT(line, HasSubstr(word)) << ranks;
    }
  }
}

}  // namespace
}  // namespace burin
