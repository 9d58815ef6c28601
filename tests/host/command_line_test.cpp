#include "burin/host/command_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "burin/common/error.hpp"

namespace burin::host {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Command parse(const std::vector<const char*>& arguments, int ranks = 1) {
  return parseCommandLine(arguments, ranks);
}

RenderOptions parseRender(std::vector<const char*> arguments, int ranks = 1) {
  arguments.insert(arguments.begin(), "render");
  return std::get<RenderOptions>(parse(arguments, ranks));
}

/// The message of a usage error; "" if there was none.
std::string usageError(const std::vector<const char*>& arguments, int ranks = 1) {
  try {
    parse(arguments, ranks);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    return error.what();
  }
  return {};
}

TEST(CommandLine, RenderHasTheDocumentedDefaults) {
  const RenderOptions options = parseRender({"dir/scene.json"});
  EXPECT_EQ(options.input, "dir/scene.json");
  EXPECT_EQ(options.output, "scene.png");
  EXPECT_FALSE(options.size);
  EXPECT_TRUE(options.worker.skip);
  EXPECT_FALSE(options.worker.dedicatedHost);
  EXPECT_FALSE(options.worker.countSamples);
  EXPECT_EQ(options.worker.bricks, 0);
  EXPECT_EQ(options.frames, 0);
  EXPECT_FALSE(options.reference);
}

TEST(CommandLine, WhereOpenGlComesFrom) {
  EXPECT_EQ(parseRender({"s.json"}).worker.gl, node::GlBackend::kOsMesa);
  EXPECT_EQ(parseRender({"s.json", "--gl", "osmesa"}).worker.gl, node::GlBackend::kOsMesa);
  EXPECT_EQ(parseRender({"s.json", "--gl", "egl"}).worker.gl, node::GlBackend::kEgl);
  EXPECT_NE(usageError({"render", "s.json", "--gl", "egl", "--reference"}), "");
}

TEST(CommandLine, InfoIsAboutAVolumeOrTheProgram) {
  EXPECT_TRUE(std::get<InfoOptions>(parse({"info", "--build"})).isBuild);
  EXPECT_FALSE(std::get<InfoOptions>(parse({"info", "v.raw"})).isBuild);
  EXPECT_NE(usageError({"info", "v.raw", "--build"}), "");
  EXPECT_NE(usageError({"info", "--build", "--histogram2d", "h.png"}), "");
}

TEST(CommandLine, Techniques) {
  const RenderOptions rays = parseRender({"s.json"});
  EXPECT_EQ(rays.worker.technique, node::Technique::kRaycast);
  EXPECT_EQ(rays.worker.precision, node::Precision::kFloat);
  const RenderOptions slices = parseRender({"s.json", "--technique", "slices"});
  EXPECT_EQ(slices.worker.technique, node::Technique::kSlices);
  EXPECT_EQ(slices.worker.precision, node::Precision::kFloat);
  for (const auto& [word, precision] : {std::pair{"float", node::Precision::kFloat},
                                        {"half", node::Precision::kHalf},
                                        {"byte", node::Precision::kByte}})
    EXPECT_EQ(
        parseRender({"s.json", "--technique", "slices", "--precision", word}).worker.precision,
        precision);
  EXPECT_THAT(usageError({"render", "s.json", "--technique", "slice"}), HasSubstr("--technique"));
  EXPECT_THAT(usageError({"render", "s.json", "--technique", "slices", "--precision", "double"}),
              HasSubstr("--precision"));
  EXPECT_EQ(usageError({"render", "s.json", "--precision", "byte"}),
            "--precision byte goes with --technique slices");
  EXPECT_THAT(usageError({"render", "s.json", "--technique", "slices", "--reference"}),
              HasSubstr("--reference"));
}

TEST(CommandLine, RenderTakesEveryOption) {
  const RenderOptions options = parseRender({"s.json",
                                             "-o",
                                             "a.exr",
                                             "--volume",
                                             "v.raw",
                                             "--size",
                                             "640x480",
                                             "--set",
                                             "a.b=1",
                                             "--set",
                                             "c=[1,2]",
                                             "--bricks",
                                             "13",
                                             "--skip",
                                             "off",
                                             "--frames",
                                             "8",
                                             "--orbit",
                                             "-90.5",
                                             "--dims",
                                             "3,4,5",
                                             "--type",
                                             "i16",
                                             "--endian",
                                             "big",
                                             "--spacing",
                                             "0.5,1,2.25",
                                             "--component",
                                             "2",
                                             "--series",
                                             "1.2.840",
                                             "--stats",
                                             "t.json",
                                             "--redraw",
                                             "--reference",
                                             "--quiet",
                                             "--count-samples",
                                             "--dedicated-host",
                                             "--save-scene",
                                             "out.json"},
                                            2);
  EXPECT_EQ(options.output, "a.exr");
  EXPECT_EQ(options.volume, "v.raw");
  EXPECT_EQ(options.size, (ImageSize{640, 480}));
  EXPECT_THAT(options.settings, ElementsAre("a.b=1", "c=[1,2]"));
  EXPECT_EQ(options.worker.bricks, 13);
  EXPECT_FALSE(options.worker.skip);
  EXPECT_TRUE(options.worker.countSamples);
  EXPECT_TRUE(options.worker.dedicatedHost);
  EXPECT_EQ(options.frames, 8);
  EXPECT_EQ(options.orbitDeg, -90.5);
  EXPECT_TRUE(options.redraw);
  EXPECT_EQ(options.raw.dims, glm::ivec3(3, 4, 5));
  EXPECT_EQ(options.raw.type, "i16");
  EXPECT_EQ(options.raw.endian, "big");
  EXPECT_EQ(options.raw.spacing, glm::dvec3(0.5, 1, 2.25));
  EXPECT_EQ(options.raw.component, 2);
  EXPECT_EQ(options.raw.series, "1.2.840");
  EXPECT_EQ(options.stats, "t.json");
  EXPECT_EQ(options.saveScene, "out.json");
  EXPECT_TRUE(options.reference);
  EXPECT_TRUE(options.quiet);
}

TEST(CommandLine, MergingIsChosen) {
  using compositor::LinkClass;
  using compositor::Packing;
  const auto defaults = parseRender({"s.json"}).merge;
  EXPECT_FALSE(defaults.composite.schedule || defaults.composite.link || defaults.isHalfOnWire);
  EXPECT_EQ(defaults.composite.packing, Packing::kAuto);
  const auto merge = parseRender({"s.json", "--composite", "radix-k", "--wire", "half", "--link",
                                  "slow", "--zstd", "off"})
                         .merge;
  ASSERT_TRUE(merge.composite.schedule.has_value());
  EXPECT_EQ(merge.composite.schedule->kind, compositor::ScheduleKind::kRadixK);
  EXPECT_EQ(merge.composite.link, LinkClass::kSlow);
  EXPECT_EQ(merge.composite.packing, Packing::kNever);
  EXPECT_TRUE(merge.isHalfOnWire);
}

TEST(CommandLine, SetDoesNotSwallowTheInput) {
  const RenderOptions options = parseRender({"--set", "a=1", "s.json", "--set", "b=2"});
  EXPECT_EQ(options.input, "s.json");
  EXPECT_THAT(options.settings, ElementsAre("a=1", "b=2"));
}

TEST(CommandLine, PictureIsNamedAfterTheInput) {
  EXPECT_EQ(parseRender({"x/head.nii.gz"}).output, "head.png");
  EXPECT_EQ(parseRender({"head.nrrd"}).output, "head.png");
  EXPECT_EQ(parseRender({"--volume", "y/foot.raw"}).output, "foot.png");
}

TEST(CommandLine, OtherCommands) {
  const auto make = std::get<MakeVolumeOptions>(
      parse({"make-volume", "shells", "--dims", "9,8,7", "--type", "f32", "-o", "a.nrrd"}));
  EXPECT_EQ(make.kind, "shells");
  EXPECT_EQ(make.dims, glm::ivec3(9, 8, 7));
  EXPECT_EQ(make.type, "f32");
  EXPECT_EQ(make.spacing, glm::dvec3(1));
  EXPECT_EQ(make.output, "a.nrrd");
  const auto info = std::get<InfoOptions>(parse({"info", "v.raw", "--dims", "1x2x3"}));
  EXPECT_EQ(info.volume, "v.raw");
  EXPECT_EQ(info.raw.dims, glm::ivec3(1, 2, 3));
  EXPECT_TRUE(std::holds_alternative<StylesOptions>(parse({"styles"})));
}

TEST(CommandLine, HelpAndVersionAreAnswers) {
  EXPECT_EQ(std::get<Answer>(parse({"--version"})).text,
            std::string{"burin "} + programVersion() + "\n");
  EXPECT_THAT(std::get<Answer>(parse({"--help"})).text, HasSubstr("make-volume"));
  const std::string render = std::get<Answer>(parse({"render", "--help"})).text;
  for (const char* option :
       {"--output",    "--volume",         "--size",   "--set",           "--bricks",
        "--skip",      "--dedicated-host", "--frames", "--orbit",         "--dims",
        "--type",      "--endian",         "--stats",  "--count-samples", "--redraw",
        "--reference", "--save-scene",     "--quiet",  "burin styles",    "schema.json",
        "--component", "--series"})
    EXPECT_THAT(render, HasSubstr(option));
  EXPECT_THAT(std::get<Answer>(parse({"make-volume", "--help"})).text, HasSubstr("vessels"));
}

struct BadUsage {
  std::vector<const char*> arguments;
  const char* named;  ///< what the message must mention
};

class CommandLineErrors : public ::testing::TestWithParam<BadUsage> {};

TEST_P(CommandLineErrors, AreOneLineThatNamesTheFault) {
  const std::string message = usageError(GetParam().arguments);
  EXPECT_THAT(message, HasSubstr(GetParam().named));
  EXPECT_THAT(message, Not(HasSubstr("\n")));
}

INSTANTIATE_TEST_SUITE_P(
    All, CommandLineErrors,
    ::testing::Values(BadUsage{{}, "make-volume"}, BadUsage{{"rendr"}, "did you mean 'render'"},
                      BadUsage{{"--quiet"}, "--quiet"}, BadUsage{{"render"}, "SCENE"},
                      BadUsage{{"render", "s.json", "--colour"}, "--colour"},
                      BadUsage{{"render", "s.json", "extra"}, "extra"},
                      BadUsage{{"render", "v.nrrd", "--volume", "w.nrrd"}, "--volume"},
                      BadUsage{{"render", "s.json", "-o", "a.jpg"}, "a.jpg"},
                      BadUsage{{"render", "s.json", "-o", "png"}, "png"},
                      BadUsage{{"render", "s.json", "--size", "640"}, "--size 640"},
                      BadUsage{{"render", "s.json", "--size", "640x"}, "--size 640x"},
                      BadUsage{{"render", "s.json", "--size", "6 x 4"}, "--size"},
                      BadUsage{{"render", "s.json", "--size", "1x1", "--size", "2x2"},
                               "--size is given twice"},
                      BadUsage{{"info", "v.raw", "--type", "u8", "--type", "u8", "--type", "u8"},
                               "--type is given 3 times"},
                      BadUsage{{"render", "s.json", "--dims", "3,4"}, "--dims 3,4"},
                      BadUsage{{"render", "s.json", "--dims", "3,4,5,6"}, "--dims 3,4,5,6"},
                      BadUsage{{"render", "s.json", "--dims", "3x4,5"}, "--dims 3x4,5"},
                      BadUsage{{"render", "s.json", "--dims", "3,4,0"}, "--dims 3,4,0"},
                      BadUsage{{"render", "s.json", "--dims", "3,4,99999999999"}, "--dims"},
                      BadUsage{{"render", "s.json", "--spacing", "1,-1,1"}, "--spacing"},
                      BadUsage{{"render", "s.json", "--spacing", "1,nan,1"}, "--spacing"},
                      BadUsage{{"render", "s.json", "--type", "u12"}, "u12"},
                      BadUsage{{"info", "v.raw", "--component", "-1"}, "--component"},
                      BadUsage{{"render", "s.json", "--endian", "middle"}, "middle"},
                      BadUsage{{"render", "s.json", "--skip", "maybe"}, "maybe"},
                      BadUsage{{"render", "s.json", "--gl", "glx"}, "glx"},
                      BadUsage{{"render", "s.json", "--bricks", "0"}, "--bricks"},
                      BadUsage{{"render", "s.json", "--bricks", "many"}, "--bricks"},
                      BadUsage{{"render", "s.json", "--frames", "0"}, "--frames"},
                      BadUsage{{"render", "s.json", "--orbit", "90"}, "--frames"},
                      BadUsage{{"render", "s.json", "--redraw"}, "--frames"},
                      BadUsage{{"render", "s.json", "--frames", "2", "--orbit", "inf"}, "--orbit"},
                      BadUsage{{"render", "s.json", "--count-samples"}, "--stats"},
                      BadUsage{{"render", "s.json", "--dedicated-host"}, "--dedicated-host"},
                      BadUsage{{"info"}, "VOLUME"},
                      BadUsage{{"make-volume", "shells", "-o", "a.nrrd"}, "--dims"},
                      BadUsage{{"make-volume", "shells", "--dims", "4,4,4"}, "--output"},
                      BadUsage{{"styles", "tone"}, "tone"}));

TEST(CommandLine, DedicatedHostNeedsTwoRanks) {
  EXPECT_NE(usageError({"render", "s.json", "--dedicated-host"}, 1), "");
  EXPECT_EQ(usageError({"render", "s.json", "--dedicated-host"}, 2), "");
}

TEST(CommandLine, ScenesAreKnownByTheirName) {
  EXPECT_TRUE(isSceneFile("a/b.json"));
  EXPECT_TRUE(isSceneFile("B.JSON"));
  EXPECT_TRUE(isSceneFile("b.jsonc"));
  EXPECT_FALSE(isSceneFile("b.nrrd"));
  EXPECT_FALSE(isSceneFile("json"));
}

BenchCompositingOptions parseBench(std::vector<const char*> arguments, int ranks = 8) {
  arguments.insert(arguments.begin(), {"bench", "compositing"});
  return std::get<BenchCompositingOptions>(parse(arguments, ranks));
}

TEST(CommandLine, BenchCompositingHasTheDocumentedDefaults) {
  const BenchCompositingOptions options = parseBench({});
  EXPECT_THAT(options.ranks, ElementsAre(2, 3, 4, 5, 6, 7, 8));
  EXPECT_THAT(options.sides, ElementsAre(512, 1024, 2048));
  EXPECT_EQ(options.repeats, 9);
  EXPECT_EQ(options.folder, "bench");
  EXPECT_EQ(options.network, "");
  EXPECT_THAT(parseBench({}, 3).ranks, ElementsAre(2, 3));
  EXPECT_THAT(parseBench({}, 24).ranks, ElementsAre(2, 3, 4, 5, 6, 7, 8, 24));
}

TEST(CommandLine, BenchCompositingTakesEveryOption) {
  const BenchCompositingOptions quick = parseBench({"scene.json", "--quick", "--out", "there"});
  EXPECT_EQ(quick.input, "scene.json");
  EXPECT_EQ(quick.folder, "there");
  EXPECT_EQ(quick.repeats, 3);
  EXPECT_THAT(quick.sides, ElementsAre(512));
  const BenchCompositingOptions chosen =
      parseBench({"--volume", "v.nrrd", "--ranks", "8,2,8", "--sizes", "64,32", "--quick",
                  "--repeats", "5", "--network", "100mbit"});
  EXPECT_EQ(chosen.volume, "v.nrrd");
  EXPECT_THAT(chosen.ranks, ElementsAre(2, 8));
  EXPECT_THAT(chosen.sides, ElementsAre(32, 64));
  EXPECT_EQ(chosen.repeats, 5);
  EXPECT_EQ(chosen.network, "100mbit");
}

TEST(CommandLine, BenchNamesWhatIsWrong) {
  EXPECT_THAT(usageError({"bench", "compositing"}, 1), HasSubstr("two ranks or more"));
  EXPECT_THAT(usageError({"bench", "compositing", "--ranks", "9"}, 8),
              HasSubstr("--ranks 9: expected 2 to 8"));
  EXPECT_THAT(usageError({"bench", "compositing", "--ranks", "1"}, 8),
              HasSubstr("--ranks 1: expected 2 to 8"));
  EXPECT_THAT(usageError({"bench", "compositing", "--sizes", "0"}, 8), HasSubstr("--sizes"));
  EXPECT_THAT(usageError({"bench", "compositing", "--network", "a,b"}, 8), HasSubstr("--network"));
  EXPECT_THAT(usageError({"bench"}, 8), HasSubstr("subcommand"));
}

BenchSkipOptions parseBenchSkip(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), {"bench", "skip"});
  return std::get<BenchSkipOptions>(parse(arguments));
}

TEST(CommandLine, BenchSkipHasTheDocumentedDefaults) {
  const BenchSkipOptions options = parseBenchSkip({});
  EXPECT_EQ(options.input, "");
  EXPECT_EQ(options.side, 256);
  EXPECT_EQ(options.repeats, 5);
  EXPECT_EQ(options.folder, "bench");
  EXPECT_FALSE(options.quick);
  EXPECT_EQ(parseBenchSkip({"--quick"}).side, 96);
}

TEST(CommandLine, BenchSkipTakesEveryOption) {
  const BenchSkipOptions chosen =
      parseBenchSkip({"--quick", "--size", "32", "--repeats", "7", "--out", "there"});
  EXPECT_EQ(chosen.side, 32);
  EXPECT_EQ(chosen.repeats, 7);
  EXPECT_EQ(chosen.folder, "there");
  const BenchSkipOptions own = parseBenchSkip({"scene.json", "--volume", "v.nrrd"});
  EXPECT_EQ(own.input, "scene.json");
  EXPECT_EQ(own.volume, "v.nrrd");
}

TEST(CommandLine, BenchSkipNamesWhatIsWrong) {
  EXPECT_THAT(usageError({"bench", "skip", "--repeats", "4"}), HasSubstr("--repeats"));
  EXPECT_THAT(usageError({"bench", "skip", "--size", "8"}), HasSubstr("--size"));
  EXPECT_THAT(usageError({"bench", "skip", "v.nrrd", "--size", "64"}),
              HasSubstr("--size 64 goes with the built-in volumes"));
  EXPECT_THAT(usageError({"bench", "skip", "a.nrrd", "--volume", "b.nrrd"}),
              HasSubstr("--volume goes with a scene"));
}

BenchScalingOptions parseBenchScaling(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), {"bench", "scaling"});
  return std::get<BenchScalingOptions>(parse(arguments));
}

TEST(CommandLine, BenchScalingHasTheDocumentedDefaults) {
  const BenchScalingOptions options = parseBenchScaling({});
  EXPECT_THAT(options.bricks, ElementsAre(1, 2, 4, 8, 16, 32, 64, 128, 256));
  EXPECT_EQ(options.side, 256);
  EXPECT_EQ(options.repeats, 3);
  EXPECT_EQ(options.folder, "bench");
  const BenchScalingOptions quick = parseBenchScaling({"--quick"});
  EXPECT_THAT(quick.bricks, ElementsAre(1, 2, 4, 8, 16, 32));
  EXPECT_EQ(quick.side, 64);
}

TEST(CommandLine, BenchScalingTakesEveryOption) {
  const BenchScalingOptions chosen =
      parseBenchScaling({"--quick", "--bricks", "8,1,8,3", "--size", "32", "--repeats", "9"});
  EXPECT_THAT(chosen.bricks, ElementsAre(1, 3, 8));
  EXPECT_EQ(chosen.side, 32);
  EXPECT_EQ(chosen.repeats, 9);
  const BenchScalingOptions own = parseBenchScaling({"scene.json", "--out", "there"});
  EXPECT_EQ(own.input, "scene.json");
  EXPECT_EQ(own.folder, "there");
}

TEST(CommandLine, BenchScalingNamesWhatIsWrong) {
  EXPECT_THAT(usageError({"bench", "scaling", "--bricks", "0"}), HasSubstr("--bricks"));
  EXPECT_THAT(usageError({"bench", "scaling", "--bricks", "1,x"}), HasSubstr("--bricks"));
  EXPECT_THAT(usageError({"bench", "scaling", "v.nrrd", "--size", "64"}),
              HasSubstr("--size 64 goes with the built-in volumes"));
}

TEST(CommandLine, BenchRates) {
  const auto parseRates = [](std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), {"bench", "rates"});
    return std::get<BenchRatesOptions>(parse(arguments));
  };
  const BenchRatesOptions defaults = parseRates({});
  EXPECT_TRUE(defaults.inputs.empty());
  EXPECT_EQ(defaults.side, 512);
  EXPECT_EQ(defaults.repeats, 5);
  EXPECT_EQ(parseRates({"--quick"}).side, 128);
  const BenchRatesOptions chosen =
      parseRates({"a.nrrd", "b.json", "--quick", "--size", "64", "--repeats", "7", "--out", "o"});
  EXPECT_THAT(chosen.inputs, ElementsAre("a.nrrd", "b.json"));
  EXPECT_EQ(chosen.side, 64);
  EXPECT_EQ(chosen.repeats, 7);
  EXPECT_EQ(chosen.folder, "o");
  EXPECT_THAT(usageError({"bench", "rates", "--repeats", "4"}), HasSubstr("--repeats"));
}

}  // namespace
}  // namespace burin::host
