// SIGINT and SIGTERM at many moments of a run, whatever it is doing: it ends, and leaves whole
// files or none.

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "host/program.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

using test::runBurin;
using test::TemporaryFolder;
using ::testing::MatchesRegex;

constexpr const char* kSignalScene = R"({"schema_version": 1,
  "volume": {"procedural": "shells", "dims": [40, 40, 40], "type": "f32"},
  "image": {"size": [200, 150]},
  "layers": [{"transfer_function": {"points": [
    {"value": 0, "color": "#fff", "opacity": 0.1}, {"value": 1, "color": "#f00", "opacity": 0.4}]},
    "style": {"light": {}}}]})";

struct Case {
  int ranks;
  const char* signal;
};

class Signal : public ::testing::TestWithParam<Case> {};

TEST_P(Signal, EndsTheProgramAndLeavesWholeFilesOnly) {
  // From before MPI has started to well within the frames.
  for (const double seconds : {0.05, 0.3, 0.7, 1.5}) {
    const TemporaryFolder folder;
    const std::string scene = folder.write("s.json", kSignalScene);
    SCOPED_TRACE(seconds);
    const auto result = runBurin(
        {"render", scene, "-o", folder / "a.exr", "--frames", "100000", "--stats",
         folder / "t.json", "--trace", folder / "c.json"},
        GetParam().ranks,
        fmt::format("timeout -s {} --preserve-status -k 10 {}", GetParam().signal, seconds));
    EXPECT_NE(result.exitCode, 0);
    EXPECT_NE(result.exitCode, 128 + 9);  // what timeout had to resort to
    for (const std::string& name : folder.names()) {
      if (name == "s.json") continue;
      EXPECT_THAT(name, MatchesRegex("a_[0-9]+\\.exr"));
      EXPECT_TRUE(OIIO::ImageInput::open(folder / name.c_str())) << name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ranks, Signal,
                         ::testing::Values(Case{0, "INT"}, Case{0, "TERM"}, Case{3, "INT"},
                                           Case{3, "TERM"}));

}  // namespace
}  // namespace burin
