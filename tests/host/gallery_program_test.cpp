#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "host/program.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

using test::onlyLine;
using test::runBurin;
using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kGalleryScene = R"({
  "schema_version": 1,
  "volume": {"procedural": "shells", "dims": [24, 24, 24], "type": "f32"},
  "image": {"size": [400, 300], "background": "#d0e0f0"},
  "layers": [{
    "transfer_function": {
      "points": [{"value": 0.3, "color": "#a06040", "opacity": 0},
                 {"value": 0.7, "color": "#fff0e0", "opacity": 0.3}],
      "opacity_unit_length": 1},
    "style": {"gradient": {"noise_floor": 0.2}}}]})";

struct SheetPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;  // 3 channels

  std::uint8_t at(int x, int y, int channel) const {
    return bytes[static_cast<std::size_t>(3 * (y * width + x) + channel)];
  }
};

SheetPicture readSheet(const std::string& file) {
  const auto in = OIIO::ImageInput::open(file);
  if (!in) throw std::runtime_error{file + ": " + OIIO::geterror()};  // fails the test
  SheetPicture picture{in->spec().width, in->spec().height, {}};
  EXPECT_EQ(in->spec().nchannels, 3);
  picture.bytes.resize(in->spec().image_pixels() * 3);
  EXPECT_TRUE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, picture.bytes.data()));
  return picture;
}

class Gallery : public ::testing::Test {
 protected:
  Gallery() { std::ofstream{path("s.json")} << kGalleryScene; }

  std::string path(const char* name) const { return folder_ / name; }

  void run(const std::vector<std::string>& arguments, int ranks = 0) {
    const auto result = runBurin(arguments, ranks);
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_THAT(result.out, IsEmpty());
  }

  const TemporaryFolder folder_;
};

constexpr int kGap = 4;
constexpr int kSide = 48;

TEST_F(Gallery, PanelsAreWhatRenderDraws) {
  const std::vector<std::string> styles{"plain", "technical", "pen-lines"};
  run({"gallery", path("s.json"), "-o", path("sheet.png"), "--styles", "plain,technical,pen-lines",
       "--columns", "2", "--size", "48x48", "--quiet"},
      3);
  const SheetPicture sheet = readSheet(path("sheet.png"));
  EXPECT_EQ(sheet.width, kGap + 2 * (kSide + kGap));
  const int rowHeight = (sheet.height - kGap) / 2;
  EXPECT_GT(rowHeight, kSide + kGap);
  for (int i = 0; i < 3; ++i) {
    const std::string& style = styles[static_cast<std::size_t>(i)];
    SCOPED_TRACE(style);
    run({"render", path("s.json"), "-o", path("one.png"), "--size", "48x48", "--set",
         "layers.0.style=" + style, "--quiet"});
    const SheetPicture one = readSheet(path("one.png"));
    int worst = 0;
    for (int y = 0; y < kSide; ++y)
      for (int x = 0; x < kSide; ++x)
        for (int c = 0; c < 3; ++c)
          worst = std::max(worst,
                           std::abs(one.at(x, y, c) - sheet.at(kGap + i % 2 * (kSide + kGap) + x,
                                                               kGap + i / 2 * rowHeight + y, c)));
    // Other ranks and brick parts: floats differ by up to 5e-5, which may cross a threshold of 8
    // bits; in the dark a code of sRGB is 3e-4 of linear light.
    EXPECT_LE(worst, 1);
    const int top = kGap + i / 2 * rowHeight + kSide;
    int darkest = 255;
    for (int y = top; y < top + rowHeight - kSide - kGap; ++y)
      for (int x = 0; x < kSide; ++x)
        darkest = std::min<int>(darkest, sheet.at(kGap + i % 2 * (kSide + kGap) + x, y, 0));
    EXPECT_LT(darkest, 128) << "no label";
  }
}

TEST_F(Gallery, AVolumeAloneDrawsEveryStyle) {
  run({"make-volume", "shells", "--dims", "12,12,12", "-o", path("v.nrrd")});
  run({"gallery", path("v.nrrd"), "-o", path("sheet.png"), "--size", "16x16", "--quiet"});
  const SheetPicture sheet = readSheet(path("sheet.png"));
  EXPECT_GE((sheet.width - kGap) / (16 + kGap), 4);  // 12 styles or more
}

// Of "separated", which has halos, surfaces and media by their gradients get the rest.
TEST_F(Gallery, LayersAreDrawnWithoutTheEffectsThatTheyCannotHave) {
  std::ofstream{path("modes.json")} << R"({ "schema_version": 1,
    "volume": {"procedural": "shells", "dims": [12, 12, 12], "type": "f32"},
    "layers": [
      {"name": "skin", "mode": "iso", "iso_value": 0.5,
       "transfer_function": {"points": [{"value": 0, "color": "#fff", "opacity": 1}]}},
      {"transfer_function": {"widgets": [
        {"shape": "rectangle", "value": [0.3, 0.7], "color": "#fff", "opacity": 0.2}]}}]})";
  const auto drawn = runBurin({"gallery", path("modes.json"), "-o", path("sheet.png"), "--styles",
                               "separated", "--size", "16x16"});
  EXPECT_EQ(drawn.exitCode, 0) << drawn.err;
  EXPECT_THAT(drawn.err,
              AllOf(HasSubstr("style separated: layer \"skin\" is drawn without its halo"),
                    HasSubstr("layer without a name")));
}

TEST_F(Gallery, SeveralInputsAreEachDrawnAsTheyAre) {
  // A scene, the same volume otherwise, and another volume without a scene.
  std::string other = kGalleryScene;
  other.replace(other.find("#fff0e0"), 7, "#20c040");
  std::ofstream{path("other.json")} << other;
  run({"make-volume", "marschner-lobb", "--dims", "12,12,12", "-o", path("v.nrrd")});
  const std::vector<std::string> inputs{path("s.json"), path("other.json"), path("v.nrrd")};
  run({"gallery", inputs[0], inputs[1], inputs[2], "-o", path("sheet.png"), "--columns", "3",
       "--size", "32x32", "--quiet"},
      2);
  const SheetPicture sheet = readSheet(path("sheet.png"));
  for (const int i : {1, 2}) {
    const std::string& input = inputs[static_cast<std::size_t>(i)];
    SCOPED_TRACE(input);
    run({"render", input, "-o", path("one.png"), "--size", "32x32", "--quiet"}, 2);
    const SheetPicture one = readSheet(path("one.png"));
    int worst = 0;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x)
        for (int c = 0; c < 3; ++c)
          worst = std::max(
              worst, std::abs(one.at(x, y, c) - sheet.at(kGap + i * (32 + kGap) + x, kGap + y, c)));
    EXPECT_EQ(worst, 0);  // the same bricks on as many ranks
  }
  const auto both =
      runBurin({"gallery", inputs[0], inputs[1], "-o", path("x.png"), "--styles", "plain"});
  EXPECT_EQ(both.exitCode, 2);
  EXPECT_THAT(onlyLine(both.err), HasSubstr("--styles goes with one INPUT"));
}

TEST_F(Gallery, MistakesAreOneLineAndLeaveNothing) {
  const auto refused = [&](const std::vector<std::string>& more, int ranks = 0) {
    std::vector<std::string> all{"gallery", path("s.json"), "-o", path("sheet.png")};
    all.insert(all.end(), more.begin(), more.end());
    const auto result = runBurin(all, ranks);
    EXPECT_EQ(result.exitCode, 2);
    return onlyLine(result.err);
  };
  EXPECT_THAT(refused({"--styles", "techincal"}, 2), HasSubstr("did you mean 'technical'?"));
  EXPECT_THAT(refused({"--size", "9000x9000"}), HasSubstr("expected at most"));
  const auto exr = runBurin({"gallery", path("s.json"), "-o", path("sheet.exr")});
  EXPECT_EQ(exr.exitCode, 2);
  EXPECT_THAT(onlyLine(exr.err), HasSubstr("ends in .png"));
  EXPECT_FALSE(std::filesystem::exists(path("sheet.png")));
}

TEST_F(Gallery, SheetLargerThanTheMemory) {
  const auto result = runBurin({"gallery", path("s.json"), "-o", path("sheet.png"), "--styles",
                                "plain,toon", "--columns", "2", "--size", "8000x8000"},
                               0, "limited() { (ulimit -v 2000000; exec \"$@\"); }; limited");
  EXPECT_EQ(result.exitCode, 4);
  // The panel as floats twice and as bytes, and two of them on the sheet as bytes.
  EXPECT_THAT(onlyLine(result.err), AllOf(HasSubstr("a sheet of 16012x80"), HasSubstr("2.5 GiB")));
}

TEST_F(Gallery, NamedStylesAreListed) {
  const auto result = runBurin({"styles"}, 2);
  EXPECT_EQ(result.exitCode, 0);
  EXPECT_THAT(result.out, HasSubstr("  technical "));
  EXPECT_THAT(result.out, HasSubstr("  pen-lines "));
}

TEST_F(Gallery, ColourMapsAreConvertedBothWays) {
  std::ofstream{path("cool.json")} << R"([{ "ColorSpace": "Diverging", "Name": "cool",
    "RGBPoints": [0, 0.2314, 0.298, 0.7529, 1, 0.7059, 0.0157, 0.149] }])";
  run({"colormap", path("cool.json"), "-o", path("look.json")}, 2);
  run({"colormap", "--paraview", path("look.json"), "-o", path("back.json")});
  run({"colormap", path("back.json"), "-o", path("again.json")});
  run({"render", path("s.json"), "-o", path("one.png"), "--size", "16x16", "--quiet", "--set",
       "layers.0.transfer_function={\"file\":\"back.json\",\"range\":[0.3,0.7]}"});
  const auto over = runBurin({"colormap", path("cool.json"), "-o", path("cool.json")});
  EXPECT_EQ(over.exitCode, 2);
  EXPECT_THAT(onlyLine(over.err), HasSubstr("overwrite"));
  const auto layer =
      runBurin({"colormap", "--paraview", path("look.json"), "--layer", "3", "-o", path("x.json")});
  EXPECT_EQ(layer.exitCode, 2);
  EXPECT_THAT(onlyLine(layer.err), HasSubstr("has 1 layer, counted from 0"));
}

}  // namespace
}  // namespace burin
