#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "burin/common/style.hpp"
#include "host/program.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

using test::onlyLine;
using test::runBurin;
using test::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Failures: the right code and one line, on one process and on three ranks (which must all end).
class Failures : public ::testing::TestWithParam<int> {
 protected:
  void expectFailure(const std::vector<std::string>& arguments, int exitCode,
                     const std::string& named) {
    const auto result = runBurin(arguments, GetParam());
    EXPECT_EQ(result.exitCode, exitCode) << result.err;
    EXPECT_THAT(onlyLine(result.err), HasSubstr(named));
    EXPECT_THAT(result.out, IsEmpty());
  }
  const TemporaryFolder folder_;
};

TEST_P(Failures, UnknownOption) {
  expectFailure({"render", "s.json", "--colour", "red"}, 2, "--colour");
}

TEST_P(Failures, MissingScene) {
  expectFailure({"render", folder_ / "none.json", "-o", folder_ / "a.png"}, 2, "none.json");
}

TEST_P(Failures, BadScene) {
  std::ofstream{folder_ / "s.json"} << R"({"schema_version": 1, "volume": {"fle": "a.nrrd"}})";
  expectFailure({"render", folder_ / "s.json", "-o", folder_ / "a.png"}, 2, "fle");
}

TEST_P(Failures, BadOverride) {
  std::ofstream{folder_ / "s.json"}
      << R"({"schema_version": 1, "volume": {"procedural": "ramp", "dims": [4, 4, 4]}})";
  expectFailure(
      {"render", folder_ / "s.json", "--set", "qualty.step_voxels=1", "-o", folder_ / "a.png"}, 2,
      "qualty");
}

TEST_P(Failures, TechniqueThatCannotDrawTheScene) {
  const std::string scene = folder_.write(
      "s.json",
      R"({"schema_version": 1, "volume": {"procedural": "ramp", "dims": [4, 4, 4]}, "layers": [)"
      R"({"transfer_function": {"points": [{"value": 1, "color": "#fff", "opacity": 0.1}]}}]})");
  const std::string picture = folder_ / "a.png";
  const std::string over = "quality.combine=over";
  expectFailure({"render", scene, "-o", picture, "--set", over}, 2, "slices only");
  expectFailure({"render", scene, "-o", picture, "--set", over, "--reference"}, 2, "combine");
  expectFailure(
      {"render", scene, "-o", picture, "--set", "quality.normals=quantised", "--reference"}, 2,
      "quality.normals");
  expectFailure({"render", scene, "-o", picture, "--set", "quality.max_error=0.1", "--technique",
                 "slices", "--precision", "byte"},
                2, "quality.max_error");
}

TEST_P(Failures, MissingVolume) {
  expectFailure({"render", folder_ / "none.nrrd", "-o", folder_ / "a.png"}, 3, "none.nrrd");
}

TEST_P(Failures, TruncatedVolume) {
  std::ofstream{folder_ / "t.nrrd"} << "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 8 8 8\n"
                                    << "encoding: raw\n\n"
                                    << std::string(100, 'x');
  expectFailure({"info", folder_ / "t.nrrd"}, 3, "t.nrrd");
}

TEST_P(Failures, FolderIsCheckedBeforeTheVolumeIsRead) {
  expectFailure({"render", folder_ / "none.nrrd", "-o", folder_ / "no/such/a.png"}, 2, "no/such");
  expectFailure({"render", folder_ / "none.nrrd", "-o", folder_ / "a.png", "--stats",
                 folder_ / "no/such/t.json"},
                2, "no/such");
  EXPECT_THAT(folder_.names(), IsEmpty());
}

TEST_P(Failures, SceneIsAFifo) {  // nobody writes to it: opening it would wait for ever
  ASSERT_EQ(::mkfifo((folder_ / "s.json").c_str(), 0600), 0);
  expectFailure({"render", folder_ / "s.json", "-o", folder_ / "a.png"}, 2, "not a regular file");
}

TEST_P(Failures, SceneIsALinkToItself) {
  std::filesystem::create_symlink("s.json", folder_ / "s.json");
  expectFailure({"render", folder_ / "s.json", "-o", folder_ / "a.png"}, 2, "s.json");
}

INSTANTIATE_TEST_SUITE_P(Ranks, Failures, ::testing::Values(0, 3));

// Files that would be lost. Nothing is written, and what there was stays.
TEST(Program, OutputsAreNeitherInputsNorEachOther) {
  const TemporaryFolder folder;
  const std::string scene =
      R"({"schema_version": 1, "volume": {"file": "v_2x2x2_uint8.raw"}, "layers": [)"
      R"({"transfer_function": {"points": [{"value": 9, "color": "#fff", "opacity": 0.1}]}}]})";
  const std::string input = folder.write("s.json", scene);
  const std::string volume = folder.write("v_2x2x2_uint8.raw", "12345678");
  const std::string picture = folder.write("p_2x2x2_uint8.png", "12345678");
  const std::string other = folder / "../";
  const std::string detour = other + folder.path().filename().string() + "/s.json";
  const std::vector<std::vector<std::string>> conflicts{
      {"render", input, "-o", folder / "a.png", "--stats", input},
      {"render", input, "-o", folder / "a.png", "--stats", detour},
      {"render", input, "-o", folder / "a.png", "--stats", folder / "a.png"},
      {"render", input, "-o", folder / "a.png", "--save-scene", folder / "a.png"},
      {"render", input, "-o", folder / "a.png", "--save-scene", volume},
      {"render", input, "-o", folder / "a.png", "--stats", folder / "t", "--save-scene",
       folder / "t"},
      {"render", input, "-o", folder / "a.png", "--frames", "2", "--stats", folder / "a_0000.png"},
      {"render", input, "-o", picture, "--volume", picture},
      {"render", volume, "-o", folder / "a.png", "--stats", volume}};
  for (const auto& arguments : conflicts) {
    const auto result = runBurin(arguments);
    EXPECT_EQ(result.exitCode, 2) << ::testing::PrintToString(arguments);
    EXPECT_THAT(onlyLine(result.err),
                ::testing::ContainsRegex("overwrite|same file|ends in .json"));
  }
  EXPECT_THAT(folder.names(),
              ::testing::ElementsAre("p_2x2x2_uint8.png", "s.json", "v_2x2x2_uint8.raw"));
  EXPECT_EQ(std::filesystem::file_size(input), scene.size());
}

TEST(Program, AFullStandardOutputIsAnError) {
  const auto result = runBurin({"styles"}, 0, "out() { \"$@\" >/dev/full; }; out");
  EXPECT_EQ(result.exitCode, 4);
  EXPECT_THAT(onlyLine(result.err), HasSubstr("standard output"));
}

TEST(Program, WithoutItsModuleItDrawsNothing) {
  const TemporaryFolder folder;
  const std::string scene = folder.write(
      "s.json",
      R"({"schema_version": 1, "volume": {"procedural": "ramp", "dims": [4, 4, 4]}, "layers": [)"
      R"({"transfer_function": {"points": [{"value": 1, "color": "#fff", "opacity": 0.1}]}}]})");
  const std::string alone = "alone() { cp \"$1\" " + (folder / "burin") + " && shift && " +
                            (folder / "burin") + " \"$@\"; }; alone";
  const auto result = runBurin({"render", scene, "-o", folder / "a.png"}, 0, alone);
  EXPECT_EQ(result.exitCode, 4);
  EXPECT_THAT(onlyLine(result.err), HasSubstr("burin_pictures.so"));
  EXPECT_THAT(folder.names(), ::testing::ElementsAre("burin", "s.json"));
  // What draws no picture does not need it.
  EXPECT_EQ(runBurin({"styles"}, 0, alone).exitCode, 0);
}

TEST(Program, OneRankIsNoDedicatedHost) {
  const auto result = runBurin({"render", "s.json", "--dedicated-host"}, 1);
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_THAT(onlyLine(result.err), HasSubstr("--dedicated-host"));
}

TEST(Program, AnswersOnceOnSeveralRanks) {
  const auto version = runBurin({"--version"}, 3);
  EXPECT_EQ(version.exitCode, 0);
  EXPECT_THAT(version.out, ::testing::MatchesRegex("burin [0-9.]+\n"));
  EXPECT_THAT(version.err, IsEmpty());
}

TEST(Program, ListsEveryStyleAndParameter) {
  const auto result = runBurin({"styles"});
  EXPECT_EQ(result.exitCode, 0);
  for (const StyleSpec& style : styleTable()) {
    EXPECT_THAT(result.out, HasSubstr(std::string{style.name}));
    for (const ParameterSpec& parameter : style.parameters)
      EXPECT_THAT(result.out, HasSubstr(std::string{parameter.name}));
  }
}

}  // namespace
}  // namespace burin
