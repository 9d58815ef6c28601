#include "burin/host/picture.hpp"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <random>
#include <sstream>

#include "burin/common/error.hpp"
#include "burin/host/command_line.hpp"
#include "burin/host/srgb_encoder.hpp"
#include "support/temporary_folder.hpp"

namespace burin::host {
namespace {

using test::TemporaryFolder;
using ::testing::ElementsAre;

const PictureMetadata kMetadata{
    R"({"name": "Schädel \"a\""})", 0.25, 12.5, "slices", "half", "over"};

/// Premultiplied pixels with values in [0, 1], more of them near 0 than not.
Image<Rgba> randomFrame(ImageSize size) {
  std::mt19937 engine{7};
  std::uniform_real_distribution<float> uniform{0, 1};
  Image<Rgba> frame{size};
  for (Rgba& pixel : frame.pixels()) {
    const float a = uniform(engine);
    pixel = {a * uniform(engine), a * uniform(engine), a * std::pow(uniform(engine), 8.0f), a};
  }
  return frame;
}

std::string contents(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream{file, std::ios::binary}.rdbuf();
  return text.str();
}

void expectMetadata(const OIIO::ImageSpec& spec) {
  EXPECT_EQ(spec.get_string_attribute("burin:scene"), kMetadata.scene);
  EXPECT_EQ(spec.get_string_attribute("burin:step_voxels"), "0.25");
  EXPECT_EQ(spec.get_string_attribute("burin:orbit_deg"), "12.5");
  EXPECT_EQ(spec.get_string_attribute("burin:technique"), "slices");
  EXPECT_EQ(spec.get_string_attribute("burin:precision"), "half");
  EXPECT_EQ(spec.get_string_attribute("burin:combine"), "over");
  EXPECT_EQ(spec.get_string_attribute("burin:version"), programVersion());
}

/// Thresholds spread evenly over (0, 1).
constexpr int kThresholds = 256;
float thresholdOf(int i) {
  return (static_cast<float>(i) + 0.5f) / kThresholds;
}

TEST(SrgbEncoder, HasTheCurvesValueOnAverage) {
  const SrgbEncoder encoder;
  // The curve's inverse, in double, from IEC 61966-2-1; written here once more on purpose.
  const auto exact = [](double x) {
    const double e = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return 255 * e;
  };
  // The mean over n thresholds is right to half of 1/n. Between codes the curve is taken as
  // straight: with f(x) the curve, wrong by at most |f''| h² / 8 for codes h = 1 / f' apart, |f''|
  // / (8 f'²), largest where the power begins: 0.008. 1e-3 covers the published forms of the
  // constants.
  const double bound = 0.5 / kThresholds + 0.009 + 1e-3;
  std::mt19937 engine{1};
  std::uniform_real_distribution<float> uniform{0, 1};
  for (int i = 0; i < 5'000; ++i) {
    const float x = i % 2 == 0 ? uniform(engine) : std::pow(uniform(engine), 6.0f);
    const double expected = exact(static_cast<double>(x));
    double mean = 0;
    for (int t = 0; t < kThresholds; ++t) {
      const int code = encoder.encode(x, thresholdOf(t));
      ASSERT_LE(std::abs(code - expected), 1 + bound) << x;
      mean += static_cast<double>(code) / kThresholds;
    }
    ASSERT_NEAR(mean, expected, bound) << x;
  }
}

TEST(SrgbEncoder, ClampsAndTakesNaN) {
  const SrgbEncoder encoder;
  for (const float threshold : {thresholdOf(0), 0.5f, thresholdOf(kThresholds - 1)}) {
    EXPECT_EQ(encoder.encode(-1.0f, threshold), 0);
    EXPECT_EQ(encoder.encode(0.0f, threshold), 0);
    EXPECT_EQ(encoder.encode(1.0f, threshold), 255);
    EXPECT_EQ(encoder.encode(7.0f, threshold), 255);
    EXPECT_EQ(encoder.encode(std::nanf(""), threshold), 0);
  }
}

TEST(SrgbEncoder, EveryCodeComesBack) {
  const SrgbEncoder encoder;
  for (int code = 0; code < 256; ++code) {
    const auto light = static_cast<float>(linearFromSrgb(code / 255.0));
    for (const float threshold : {thresholdOf(0), 0.5f, thresholdOf(kThresholds - 1)}) {
      EXPECT_EQ(encoder.encode(light, threshold), code);
      // Nor does the last digit of a float matter.
      EXPECT_EQ(encoder.encode(std::nextafter(light, 0.0f), threshold), code);
      EXPECT_EQ(encoder.encode(std::nextafter(light, 1.0f), threshold), code);
    }
  }
}

TEST(ToDisplay, PutsTheFrameOverTheBackground) {
  Image<Rgba> frame{{3, 1}};
  const auto code128 = static_cast<float>(linearFromSrgb(128 / 255.0));
  frame.at(1, 0) = {1 - code128, 0, 0, 1 - code128};
  frame.at(2, 0) = {0, 0, 1, 1};
  const DisplayPicture picture = toDisplay(frame, Colour{255, 255, 255});
  EXPECT_EQ(picture.channels, 3);
  EXPECT_THAT(picture.bytes, ElementsAre(255, 255, 255, 255, 128, 128, 0, 0, 255));
}

TEST(ToDisplay, TransparentIsStraightAlpha) {
  Image<Rgba> frame{{2, 1}};
  const float quarter = 51 / 255.0f;
  frame.at(1, 0) = {quarter, quarter * static_cast<float>(linearFromSrgb(200 / 255.0)), 0, quarter};
  const DisplayPicture picture = toDisplay(frame, std::nullopt);
  EXPECT_EQ(picture.channels, 4);
  EXPECT_THAT(picture.bytes, ElementsAre(0, 0, 0, 0, 255, 200, 0, 51));
}

// A faint ramp, three codes over 256 pixels: rounding alone would give three flat bands.
TEST(ToDisplay, ASlowRampKeepsItsMeanInEveryNeighbourhood) {
  constexpr int kSize = 256;
  constexpr int kBlock = 8;
  const auto codeAt = [](int x) { return 40 + 3.0 * x / kSize; };
  Image<Rgba> frame{{kSize, kSize}};
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const auto light = static_cast<float>(linearFromSrgb(codeAt(x) / 255));
      frame.at(x, y) = {light, light, light, 1};
    }
  }
  const DisplayPicture picture = toDisplay(frame, Colour{});
  double worst = 0;
  for (int top = 0; top < kSize; top += kBlock) {
    for (int left = 0; left < kSize; left += kBlock) {
      double difference = 0;
      for (int i = 0; i < kBlock * kBlock; ++i) {
        const int x = left + i % kBlock;
        const int y = top + i / kBlock;
        difference += picture.bytes[3 * static_cast<std::size_t>(y * kSize + x)] - codeAt(x);
      }
      worst = std::max(worst, std::abs(difference) / (kBlock * kBlock));
    }
  }
  std::printf("worst mean of 8 x 8 pixels: %.3f codes off\n", worst);
  // Independent random thresholds would be off by 0.5 / 8 (one standard deviation) and by four
  // times that in the worst of 1024 blocks; an even sequence of 64 has discrepancy below 4 / 64.
  EXPECT_LT(worst, 4.0 / 64);
}

TEST(Picture, ExrKeepsEveryBit) {
  const TemporaryFolder folder;
  const Image<Rgba> frame = randomFrame({37, 23});
  writeExr(folder / "a.exr", frame, kMetadata);
  EXPECT_THAT(folder.names(), ElementsAre("a.exr"));
  const auto in = OIIO::ImageInput::open(folder / "a.exr");
  ASSERT_TRUE(in);
  EXPECT_THAT(in->spec().channelnames, ElementsAre("R", "G", "B", "A"));
  EXPECT_EQ(in->spec().format, OIIO::TypeDesc::FLOAT);
  expectMetadata(in->spec());
  Image<Rgba> read{{in->spec().width, in->spec().height}};
  ASSERT_TRUE(in->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, read.pixels().data()));
  EXPECT_EQ(read.size(), frame.size());
  EXPECT_TRUE(std::ranges::equal(read.pixels(), frame.pixels()));
}

TEST(Picture, PngKeepsEveryCode) {
  for (const bool isOpaque : {true, false}) {
    const TemporaryFolder folder;
    const auto picture =
        toDisplay(randomFrame({37, 23}), isOpaque ? std::optional{Colour{1, 2, 3}} : std::nullopt);
    writePng(folder / "a.png", picture, kMetadata);
    OIIO::ImageSpec asStored;
    asStored.attribute("oiio:UnassociatedAlpha", 1);
    const auto in = OIIO::ImageInput::open(folder / "a.png", &asStored);
    ASSERT_TRUE(in);
    EXPECT_EQ(in->spec().nchannels, picture.channels);
    expectMetadata(in->spec());
    std::vector<std::uint8_t> read(picture.bytes.size());
    ASSERT_TRUE(in->read_image(0, 0, 0, picture.channels, OIIO::TypeDesc::UINT8, read.data()));
    EXPECT_EQ(read, picture.bytes);
  }
}

TEST(Picture, SamePictureSameBytes) {
  const TemporaryFolder folder;
  const Image<Rgba> frame = randomFrame({37, 23});
  for (const char* name : {"a", "b"}) {
    writeExr(folder.path() / (std::string{name} + ".exr"), frame, kMetadata);
    writePng(folder.path() / (std::string{name} + ".png"), toDisplay(frame, Colour{}), kMetadata);
  }
  EXPECT_TRUE(contents(folder / "a.exr") == contents(folder / "b.exr"));
  EXPECT_TRUE(contents(folder / "a.png") == contents(folder / "b.png"));
}

/// No file may grow beyond `bytes` in its lifetime, as on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_{std::signal(SIGXFSZ, SIG_IGN)} {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(Picture, FullDiskLeavesTheOldPictureAndNothingElse) {
  const TemporaryFolder folder;
  const Image<Rgba> frame = randomFrame({64, 64});  // random: 16 kB do not compress to 4
  for (const char* name : {"a.exr", "a.png"}) {
    std::ofstream{folder / name} << "old";
    const FileSizeLimit limit{4096};
    try {
      if (std::string{name} == "a.exr") {
        writeExr(folder / name, frame, kMetadata);
      } else {
        writePng(folder / name, toDisplay(frame, std::nullopt), kMetadata);
      }
      ADD_FAILURE() << name << " was written beyond the limit";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kRank);
      EXPECT_THAT(error.what(), ::testing::HasSubstr(name));
    }
    EXPECT_TRUE(contents(folder / name) == "old") << name;
  }
  EXPECT_THAT(folder.names(), ElementsAre("a.exr", "a.png"));
}

}  // namespace
}  // namespace burin::host
