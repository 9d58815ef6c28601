#include "burin/common/statistics.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace burin {
namespace {

using Json = nlohmann::json;

RunStatistics twoFramesOnTwoRanks() {
  RankStatistics rank;
  rank.rank = 1;
  rank.bricks = 3;
  rank.phases[Phase::kDraw] = 12.5;
  rank.samplesVisited = 10;
  rank.samplesShaded = 11;
  rank.samplesInOccupiedCells = 12;
  rank.leaps = 13;
  rank.bytesSent = 14;
  rank.bytesReceived = 15;
  rank.messagesSent = 16;
  rank.bytesToRoot = 20;
  rank.bytesByReference = 21;
  rank.bytesPackedAway = 22;
  rank.activePixels = 17;
  rank.residentVoxelBytes = std::int64_t{5} << 32;  // beyond 32 bits
  rank.peakRssBytes = 19;
  FrameStatistics frame;
  frame.frameMs = 40.25;
  for (int i = 0; i < static_cast<int>(Phase::kCount); ++i) frame.phases[Phase{i}] = i + 0.5;
  frame.ranks = {RankStatistics{}, rank};
  RunStatistics run;
  run.ranks = 2;
  run.frames = {frame, frame};
  return run;
}

TEST(StatisticsJson, FollowsTheContract) {
  RunStatistics run = twoFramesOnTwoRanks();
  run.samplesCounted = true;
  const Json json = Json::parse(statisticsJson(run));
  EXPECT_EQ(json.at("ranks"), 2);
  ASSERT_EQ(json.at("frames").size(), 2u);
  const Json& frame = json.at("frames").at(1);
  EXPECT_EQ(frame.at("frame_ms"), 40.25);
  EXPECT_EQ(frame.at("phases_ms"), (Json{{"update", 0.5},
                                         {"draw", 1.5},
                                         {"composite", 2.5},
                                         {"gather", 3.5},
                                         {"finish", 4.5},
                                         {"write", 5.5}}));
  ASSERT_EQ(frame.at("ranks").size(), 2u);
  Json rank = frame.at("ranks").at(1);
  EXPECT_EQ(rank.at("phases_ms").at("draw"), 12.5);
  EXPECT_EQ(rank.at("phases_ms").size(), 6u);
  rank.erase("phases_ms");
  EXPECT_EQ(rank, (Json{{"rank", 1},
                        {"bricks", 3},
                        {"samples_visited", 10},
                        {"samples_shaded", 11},
                        {"samples_in_occupied_cells", 12},
                        {"leaps", 13},
                        {"bytes_sent", 14},
                        {"bytes_received", 15},
                        {"messages_sent", 16},
                        {"bytes_to_root", 20},
                        {"bytes_by_reference", 21},
                        {"bytes_packed_away", 22},
                        {"active_pixels", 17},
                        {"resident_voxel_bytes", std::int64_t{5} << 32},
                        {"peak_rss_bytes", 19}}));
}

TEST(StatisticsJson, SaysHowAFrameWasMerged) {
  RunStatistics run = twoFramesOnTwoRanks();
  run.frames[1].composite = {"radix-k", "half", 2, 3, true};
  const Json json = Json::parse(statisticsJson(run));
  EXPECT_FALSE(json.at("frames").at(0).contains("composite"));  // nothing was merged
  EXPECT_EQ(json.at("frames").at(1).at("composite"), (Json{{"schedule", "radix-k"},
                                                           {"wire", "half"},
                                                           {"participants", 2},
                                                           {"hosts", 3},
                                                           {"packed", true}}));
}

TEST(StatisticsJson, SaysWhichFramesWereNotDrawn) {
  RunStatistics run = twoFramesOnTwoRanks();
  run.frames[1].isUnchanged = true;
  const Json json = Json::parse(statisticsJson(run));
  EXPECT_FALSE(json.at("frames").at(0).contains("unchanged"));
  EXPECT_EQ(json.at("frames").at(1).at("unchanged"), true);
}

TEST(StatisticsJson, LeavesOutWhatWasNotCounted) {
  const Json json = Json::parse(statisticsJson(twoFramesOnTwoRanks()));
  const Json& rank = json.at("frames").at(0).at("ranks").at(1);
  for (const char* key :
       {"samples_visited", "samples_shaded", "samples_in_occupied_cells", "leaps"}) {
    EXPECT_FALSE(rank.contains(key)) << key;
  }
  EXPECT_EQ(rank.at("bytes_sent"), 14);
}

TEST(StatisticsJson, NoFramesIsAnEmptyList) {
  EXPECT_EQ(Json::parse(statisticsJson({})).at("frames"), Json::array());
}

TEST(PeakResidentBytes, SeesTouchedMemoryAndKeepsThePeak) {
  constexpr std::size_t kBytes = std::size_t{96} << 20;
  const std::int64_t before = peakResidentBytes();
  EXPECT_GT(before, 0);
  {
    const std::vector<char> touched(kBytes, 1);
    EXPECT_EQ(touched.back(), 1);
  }
  const std::int64_t after = peakResidentBytes();
  EXPECT_GE(after, static_cast<std::int64_t>(kBytes));
  EXPECT_GE(after, before);
}

TEST(PhaseTimer, AddsToWhatIsThere) {
  PhaseTimes phases;
  phases[Phase::kGather] = 1e6;
  { const PhaseTimer timer{phases[Phase::kGather]}; }
  EXPECT_GE(phases[Phase::kGather], 1e6);
  EXPECT_EQ(phases[Phase::kDraw], 0);
}

}  // namespace
}  // namespace burin
