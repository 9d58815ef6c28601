// What a user can get wrong or a machine lack, met by the whole program: the exit code, one line
// that says what is wrong, and nothing left behind; on one process and on three ranks. The
// messages' words are tested where they are made.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "host/program.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

using test::onlyLine;
using test::runBurin;
using test::TemporaryFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Matcher;

/// All of the volume shows.
constexpr const char* kFailingScene = R"({"schema_version": 1,
  "volume": {"procedural": "shells", "dims": [6, 5, 4]},
  "image": {"size": [64, 48]},
  "layers": [{"transfer_function": {"points": [
    {"value": 0, "color": "#fff", "opacity": 0.1}, {"value": 255, "color": "#f00", "opacity": 0.4}]}}]})";

class FailingProgram : public ::testing::TestWithParam<int> {
 protected:
  /// `render` of the scene, with further arguments, must fail so. `prefix`: as of runBurin.
  void expectFailure(const std::vector<std::string>& arguments, int exitCode,
                     const Matcher<std::string>& says, const std::string& prefix = "") {
    std::vector<std::string> all{"render", scene_};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const auto before = folder_.names();
    const auto result = runBurin(all, GetParam(), prefix);
    EXPECT_EQ(result.exitCode, exitCode) << result.err;
    EXPECT_THAT(onlyLine(result.err), says);
    EXPECT_EQ(folder_.names(), before);
  }

  const TemporaryFolder folder_;
  const std::string scene_ = folder_.write("s.json", kFailingScene);
  const std::string picture_ = folder_ / "a.png";
};

TEST_P(FailingProgram, CameraThatLooksNowhere) {
  const std::string eye = "camera={\"eye\":[1,2,3],\"target\":[1,2,3]}";
  expectFailure({"-o", picture_, "--set", eye}, 2, HasSubstr("'target' equals 'eye'"));
  const std::string up = "camera={\"eye\":[0,0,50],\"target\":[0,0,0],\"up\":[0,0,1]}";
  expectFailure({"-o", picture_, "--set", up}, 2, HasSubstr("parallel to the view"));
}

TEST_P(FailingProgram, FolderThatTakesNoFiles) {  // not even root's
  expectFailure({"-o", "/proc/a.png"}, 2, HasSubstr("/proc/a.png: cannot write here"));
  expectFailure({"-o", picture_, "--stats", "/proc/t.json"}, 2, HasSubstr("/proc/t.json"));
}

TEST_P(FailingProgram, DiskThatIsFull) {
  for (const char* name : {"a.exr", "a.png"})
    expectFailure({"-o", folder_ / name}, 4,
                  AllOf(HasSubstr(name), HasSubstr("cannot be written whole: No space left")),
                  std::string{"LD_PRELOAD="} + BURIN_FULL_DISK);
}

TEST_P(FailingProgram, FileLargerThanTheLimit) {
  expectFailure({"-o", folder_ / "a.exr"}, 4,
                HasSubstr("a.exr: cannot be written whole: File too large"),
                std::string{"BURIN_LARGEST_FILE=512 LD_PRELOAD="} + BURIN_FULL_DISK);
}

TEST_P(FailingProgram, PictureLargerThanTheMemory) {
  expectFailure({"-o", picture_, "--size", "16384x16384"}, 4,
                AllOf(HasSubstr("16384x16384 pixels needs 9.0 GiB"), HasSubstr("ulimit -v")),
                "limited() { (ulimit -v 6000000; exec \"$@\"); }; limited");
}

TEST_P(FailingProgram, BrickLargerThanTheMemory) {
  folder_.write("v_1024x1024x384_uint8.raw", "");
  std::filesystem::resize_file(folder_ / "v_1024x1024x384_uint8.raw", 1024 * 1024 * 384);
  expectFailure(
      {"-o", picture_, "--volume", folder_ / "v_1024x1024x384_uint8.raw", "--bricks", "1"}, 4,
      AllOf(HasSubstr("memory: rank 0: 1 brick with "), HasSubstr("MiB"), HasSubstr("ulimit")),
      "limited() { (ulimit -v 1000000; exec \"$@\"); }; limited");
}

/// Libraries of these names that are none come first.
TEST_P(FailingProgram, NoOpenGl) {
  std::filesystem::create_directory(folder_ / "lib");
  for (const char* name : {"lib/libOSMesa.so.8", "lib/libOSMesa.so.6", "lib/libOSMesa.so"})
    folder_.write(name, "no library");
  expectFailure({"-o", picture_}, 4, HasSubstr("install the package libosmesa6"),
                "LD_LIBRARY_PATH='" + (folder_ / "lib") + "'");
}

INSTANTIATE_TEST_SUITE_P(Ranks, FailingProgram, ::testing::Values(0, 3));

}  // namespace
}  // namespace burin
