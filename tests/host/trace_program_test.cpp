// The file of --trace: a row for each rank with everything it did, times that fit together and
// agree with --stats.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/program.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

using nlohmann::json;
using test::runBurin;
using test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::IsSupersetOf;

constexpr const char* kTracedScene = R"({"schema_version": 1,
  "volume": {"procedural": "shells", "dims": [20, 18, 16], "type": "f32"},
  "image": {"size": [64, 48]},
  "layers": [{"transfer_function": {"points": [
    {"value": 0, "color": "#fff", "opacity": 0.1}, {"value": 1, "color": "#f00", "opacity": 0.4}]},
    "style": {"light": {}}}]})";

/// Events are written in whole nanoseconds, but as decimal fractions of microseconds.
constexpr double kRounding = 0.6e-3;

struct Event {
  std::string name;
  double begin = 0, end = 0;  ///< microseconds
};

using Row = std::vector<Event>;

std::vector<Row> rowsOf(const json& document, int ranks) {
  std::vector<Row> rows(static_cast<std::size_t>(ranks));
  std::vector<std::string> names(rows.size());
  for (const json& entry : document.at("traceEvents")) {
    const auto rank = entry.at("tid").get<std::size_t>();
    if (entry.at("ph") == "M") {
      names.at(rank) = entry.at("args").at("name").get<std::string>();
      continue;
    }
    EXPECT_EQ(entry.at("ph"), "X");
    const auto begin = entry.at("ts").get<double>();
    const auto duration = entry.at("dur").get<double>();
    EXPECT_GE(begin, 0);
    EXPECT_GE(duration, 0);
    rows.at(rank).push_back({entry.at("name").get<std::string>(), begin, begin + duration});
  }
  for (std::size_t rank = 0; rank < names.size(); ++rank)
    EXPECT_EQ(names[rank], "rank " + std::to_string(rank));
  return rows;
}

/// Viewers draw a row's events inside each other: any two are apart, or one is within the other.
void expectNested(Row row) {
  std::ranges::sort(row, [](const Event& a, const Event& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.end > b.end;
  });
  std::vector<Event> open;
  for (const Event& event : row) {
    while (!open.empty() && open.back().end <= event.begin + kRounding) open.pop_back();
    if (!open.empty()) {
      EXPECT_LE(event.end, open.back().end + kRounding) << event.name << " in " << open.back().name;
    }
    open.push_back(event);
  }
}

std::vector<Event> named(const Row& row, const std::string& name) {
  std::vector<Event> some;
  std::ranges::copy_if(row, std::back_inserter(some),
                       [&](const Event& event) { return event.name == name; });
  return some;
}

std::set<std::string> namesIn(const Row& row) {
  std::set<std::string> names;
  for (const Event& event : row) names.insert(event.name);
  return names;
}

class Trace : public ::testing::TestWithParam<int> {
 protected:
  void draw() {
    const std::string scene = folder_.write("s.json", kTracedScene);
    const auto result = runBurin({"render", scene, "-o", folder_ / "a.png", "--frames", "3",
                                  "--trace", folder_ / "c.json", "--stats", folder_ / "t.json"},
                                 GetParam());
    ASSERT_EQ(result.exitCode, 0) << result.err;
    ranks_ = std::max(1, GetParam());
    trace_ = json::parse(std::ifstream{folder_ / "c.json"});
    statistics_ = json::parse(std::ifstream{folder_ / "t.json"});
  }

  const TemporaryFolder folder_;
  int ranks_ = 0;
  json trace_, statistics_;
};

TEST_P(Trace, HasEveryRankAndPhaseAndAgreesWithTheStatistics) {
  draw();
  EXPECT_THAT(folder_.names(),
              ElementsAre("a_0000.png", "a_0001.png", "a_0002.png", "c.json", "s.json", "t.json"));
  const double accuracy = trace_.at("otherData").at("clock_accuracy_us").get<double>();
  EXPECT_GE(accuracy, 0);
  EXPECT_EQ(accuracy > 0, ranks_ > 1);
  const std::vector<Row> rows = rowsOf(trace_, ranks_);
  std::vector<std::string> everywhere{"set up",    "survey",   "load",   "upload",
                                      "compile",   "classify", "frame",  "update",
                                      "composite", "plan",     "gather", "draw"};
  if (ranks_ > 1) everywhere.insert(everywhere.end(), {"round", "receive"});
  for (std::size_t rank = 0; rank < rows.size(); ++rank) {
    SCOPED_TRACE(rank);
    expectNested(rows[rank]);
    EXPECT_THAT(namesIn(rows[rank]), IsSupersetOf(everywhere));
    EXPECT_EQ(namesIn(rows[rank]).contains("write"), rank == 0);
    EXPECT_EQ(namesIn(rows[rank]).contains("finish"), rank == 0);
    for (const char* phase : {"update", "draw", "composite", "gather", "finish", "write"}) {
      double traced = 0;
      for (const Event& event : named(rows[rank], phase)) traced += event.end - event.begin;
      double counted = 0;
      for (const json& frame : statistics_.at("frames"))
        counted += 1000 * frame.at("ranks").at(rank).at("phases_ms").at(phase).get<double>();
      EXPECT_NEAR(traced, counted, 3 * kRounding) << phase;
    }
    // Compositing is a meeting: at some moment all ranks were in it.
    const auto mine = named(rows[rank], "composite");
    const auto root = named(rows[0], "composite");
    ASSERT_EQ(mine.size(), 3u);
    for (std::size_t i = 0; i < mine.size(); ++i) {
      EXPECT_LE(mine[i].begin, root[i].end + accuracy);
      EXPECT_LE(root[i].begin, mine[i].end + accuracy);
    }
  }
}

TEST(TraceWithoutAScene, TheVolumeIsSurveyedOnce) {
  const TemporaryFolder folder;
  const auto made = runBurin(
      {"make-volume", "shells", "--dims", "20,18,16", "--type", "u8", "-o", folder / "v.nrrd"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  const auto drawn = runBurin({"render", folder / "v.nrrd", "-o", folder / "a.png", "--size",
                               "48x40", "--trace", folder / "c.json"});
  ASSERT_EQ(drawn.exitCode, 0) << drawn.err;
  const std::vector<Row> rows = rowsOf(json::parse(std::ifstream{folder / "c.json"}), 1);
  EXPECT_EQ(named(rows[0], "survey").size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Ranks, Trace, ::testing::Values(0, 3));

}  // namespace
}  // namespace burin
