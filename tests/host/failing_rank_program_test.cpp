// One rank fails, throwing or killed, at any time of a run, and the program ends: within seconds,
// with one line that says which rank, and without half-written files.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <thread>

#include "host/program.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

namespace fs = std::filesystem;

using test::ProgramResult;
using test::runBurin;
using test::TemporaryFolder;
using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kRankScene = R"({"schema_version": 1,
  "volume": {"procedural": "shells", "dims": [12, 10, 8], "type": "f32"},
  "image": {"size": [48, 40]},
  "layers": [{"transfer_function": {"points": [
    {"value": 0, "color": "#fff", "opacity": 0.1}, {"value": 1, "color": "#f00", "opacity": 0.4}]},
    "style": {"light": {}}}]})";

std::string contents(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream{file, std::ios::binary}.rdbuf();
  return text.str();
}

/// The one line that is burin's; the launcher may have something to say about how it was left.
std::string burinsLine(const std::string& err) {
  std::istringstream lines{err};
  std::vector<std::string> ours;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("burin: ")) ours.push_back(line);
  EXPECT_EQ(ours.size(), 1u) << err;
  return ours.empty() ? std::string{} : ours.front();
}

class FailingRank : public ::testing::TestWithParam<int> {
 protected:
  /// Ends it with code 124 if it hangs; the launcher then ends its ranks.
  static constexpr const char* kAtMost = "timeout -k 5 60 ";

  ProgramResult render(const std::vector<std::string>& arguments, const std::string& prefix = "") {
    std::vector<std::string> all{"render", scene_, "--quiet"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return runBurin(all, GetParam(), prefix + kAtMost);
  }
  void expectNothingTemporary() const {
    for (const std::string& name : folder_.names()) EXPECT_THAT(name, Not(EndsWith(".tmp")));
  }

  const TemporaryFolder folder_;
  const std::string scene_ = folder_.write("s.json", kRankScene);
};

TEST_P(FailingRank, ThrowsAtAnyTime) {
  const int moments = GetParam() == 0 ? 8 : 4;  // for each rank
  const std::vector<std::string> draw{"-o", folder_ / "a.exr", "--frames",
                                      "6",  "--redraw",        "--orbit",
                                      "0",  "--stats",         folder_ / "t.json"};
  const std::string preload = std::string{"LD_PRELOAD="} + BURIN_FAILING_NEW + " ";
  const auto whole = render(draw, "BURIN_COUNT_FILE='" + (folder_ / "count") + "' " + preload);
  ASSERT_EQ(whole.exitCode, 0) << whole.err;
  const std::string picture = contents(folder_ / "a_0000.exr");
  std::set<std::string> said;
  for (int rank = 0; rank < std::max(1, GetParam()); ++rank) {
    const long count =
        std::atol(contents(folder_ / ("count" + std::to_string(rank)).c_str()).c_str());
    ASSERT_GT(count, 10 * moments);
    for (int moment = 0; moment < moments; ++moment) {
      const long at = count * (2 * moment + 1) / (2 * moments);
      SCOPED_TRACE(fmt::format("rank {}, allocation {} of {}", rank, at, count));
      const auto result =
          render(draw, fmt::format("BURIN_FAIL_RANK={} BURIN_FAIL_AT={} {}", rank, at, preload));
      expectNothingTemporary();
      // Some failures are met with another way to the same picture.
      if (result.exitCode == 0) {
        EXPECT_TRUE(contents(folder_ / "a_0005.exr") == picture);
        continue;
      }
      EXPECT_EQ(result.exitCode, 4) << result.err;
      said.insert(burinsLine(result.err));
      // What rank 0 does for all concerns no rank in particular.
      if (rank > 0) {
        EXPECT_THAT(result.err, HasSubstr(fmt::format("rank {}: ", rank)));
      }
      // The library that encodes pictures keeps the reason to itself.
      EXPECT_THAT(result.err, AnyOf(HasSubstr("bad_alloc"), HasSubstr("cannot be written")));
    }
  }
  EXPECT_GE(said.size(), 2u);  // not all in one phase
}

/// A rank of the program that was started with `argument`.
std::optional<pid_t> processOf(int rank, const std::string& argument) {
  for (const auto& entry : fs::directory_iterator{"/proc"}) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string environment = '\0' + contents(entry.path() / "environ");
    const std::string variable = fmt::format("OMPI_COMM_WORLD_RANK={}", rank);
    if (environment.find('\0' + variable + '\0') != std::string::npos &&
        contents(entry.path() / "cmdline").find(argument) != std::string::npos)
      return std::stoi(name);
  }
  return std::nullopt;
}

/// Waits until `isTrue()`, for a minute at most.
template <typename Condition>
bool waitFor(Condition&& isTrue) {
  for (int i = 0; i < 6000; ++i) {
    if (isTrue()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds{10});
  }
  return false;
}

class KilledRank : public FailingRank {
 protected:
  /// Kills `rank` as soon as `isTime(its process)`; returns how the program ends.
  template <typename Condition>
  ProgramResult kill(int rank, const std::vector<std::string>& arguments, Condition&& isTime) {
    ProgramResult result;
    std::thread program{[&] { result = render(arguments); }};
    std::optional<pid_t> process;
    const bool isFound = waitFor([&] { return (process = processOf(rank, scene_)).has_value(); }) &&
                         waitFor([&] { return isTime(*process); });
    EXPECT_TRUE(isFound);
    if (isFound) ::kill(*process, SIGKILL);
    program.join();
    expectNothingTemporary();
    EXPECT_THAT(result.exitCode, ::testing::AnyOf(128 + SIGKILL, 4));  // the launcher's, or ours
    EXPECT_THAT(burinsLine(result.err),
                HasSubstr(fmt::format("rank {} (process {}) has ended without a word", rank,
                                      process.value_or(0))));
    return result;
  }
};

TEST_P(KilledRank, IsNamedWhileFramesAreDrawn) {
  for (int rank = 0; rank < GetParam(); ++rank) {
    kill(rank, {"-o", folder_ / "a.png", "--frames", "100000"},
         [&](pid_t) { return fs::exists(folder_ / "a_0001.png"); });
    for (const std::string& name : folder_.names())
      if (name != "s.json") fs::remove(folder_.path() / name);
  }
}

TEST_P(KilledRank, IsNamedWhileTheVolumeIsRead) {
  const std::string volume = folder_.write("v_2000x2000x4000_uint8.raw", "");
  fs::resize_file(volume, 16'000'000'000);
  const auto hasOpened = [&](pid_t process) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator{fmt::format("/proc/{}/fd", process), ignored}) {
      if (fs::read_symlink(entry.path(), ignored) == volume) return true;
    }
    return false;
  };
  kill(1, {"-o", folder_ / "a.png", "--volume", volume}, hasOpened);
}

INSTANTIATE_TEST_SUITE_P(Ranks, FailingRank, ::testing::Values(0, 3));
INSTANTIATE_TEST_SUITE_P(Ranks, KilledRank, ::testing::Values(3));

}  // namespace
}  // namespace burin
