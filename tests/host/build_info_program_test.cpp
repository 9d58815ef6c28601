// `burin info --build`, as far as the truth is known otherwise.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mpi.h>
#include <zstd.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "host/program.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

using test::onlyLine;
using test::runBurin;
using test::TemporaryFolder;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// Labels and what stands beside them.
std::map<std::string, std::string> buildInfo(int ranks = 0, const std::string& prefix = "") {
  const auto result = runBurin({"info", "--build"}, ranks, prefix);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  std::map<std::string, std::string> facts;
  std::istringstream lines{result.out};
  for (std::string line; std::getline(lines, line);) {
    const std::string label = line.substr(0, line.find(' '));
    EXPECT_FALSE(facts.contains(label)) << label;
    facts[label] = line.substr(line.find_first_not_of(' ', label.size()));
  }
  return facts;
}

TEST(BuildInfo, SaysWhatTheLibrariesSay) {
  auto facts = buildInfo(3);
  EXPECT_EQ("burin " + facts["burin"] + "\n", runBurin({"--version"}).out);
  EXPECT_THAT(facts["compiler"], HasSubstr(__VERSION__));  // the tests' is the program's
  EXPECT_THAT(facts["MPI"],
              HasSubstr(fmt::format("(MPI {}.{}), 3 ranks now", MPI_VERSION, MPI_SUBVERSION)));
  EXPECT_EQ(facts["zstd"], ZSTD_versionString());
  EXPECT_THAT(facts["OpenImageIO"], ::testing::MatchesRegex("[0-9]+\\.[0-9.]+"));
  EXPECT_THAT(facts["OSMesa"], ContainsRegex("OpenGL 4\\.5 .*Mesa [0-9.]+"));
  EXPECT_THAT(facts["OSMesa"], HasSubstr("llvmpipe"));
  EXPECT_THAT(facts["EGL"], ContainsRegex("OpenGL 4\\.[56]|install the package"));
  EXPECT_THAT(facts["limits"], StartsWith("pictures to 16384x16384"));
}

TEST(BuildInfo, ThreadsAreThoseOfTheAffinityMaskUnlessTheUserSaysOtherwise) {
  EXPECT_THAT(buildInfo(0, "taskset -c 0 env -u LP_NUM_THREADS")["threads"],
              StartsWith("1 for rank 0, which may use 1 of "));
  EXPECT_THAT(buildInfo(0, "LP_NUM_THREADS=7")["threads"], StartsWith("7 for rank 0"));
}

TEST(BuildInfo, SaysWhatIsMissing) {
  const TemporaryFolder folder;
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so", "libEGL.so.1"})
    folder.write(name, "no library");
  auto facts = buildInfo(0, "LD_LIBRARY_PATH='" + folder.path().string() + "'");
  EXPECT_THAT(facts["OSMesa"], HasSubstr("install the package libosmesa6"));
  EXPECT_THAT(facts["EGL"], HasSubstr("install the packages libegl1 and libgl1-mesa-dri"));
}

TEST(BuildInfo, IsAboutTheProgramOrAVolume) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"info"}, {"info", "--build", "a.nrrd"}}) {
    const auto result = runBurin(arguments);
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_THAT(onlyLine(result.err), HasSubstr("--build"));
    EXPECT_THAT(result.out, IsEmpty());
  }
}

}  // namespace
}  // namespace burin
