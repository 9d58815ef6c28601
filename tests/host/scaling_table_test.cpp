#include "bench/scaling_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "bench/scaling_scenes.hpp"

namespace burin::host::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

ScalingMeasurement row(std::string kind, int ranks, double slowest, double mean, double composite) {
  ScalingMeasurement measured;
  measured.kind = std::move(kind);
  measured.scene = "head";
  measured.ranks = ranks;
  measured.renderMaxMs = slowest;
  measured.renderMeanMs = mean;
  measured.compositeMs = composite;
  measured.frameMs = slowest + composite;
  measured.frame = {512, 256};
  measured.dims = {65, 33, 17};
  measured.repeats = 3;
  return measured;
}

// Scripts rely on the first seven columns.
TEST(ScalingTable, CsvHasTheContractsColumns) {
  std::vector rows{row("strong", 8, 3, 2, 0.5), row("weak", 2, 1, 1, 0)};
  rows[1].isIsolated = false;
  const std::string csv = scalingTableCsv(rows);
  EXPECT_THAT(csv, StartsWith("kind,mode,ranks,render_max_ms,render_mean_ms,composite_ms,"
                              "frame_ms,"));
  EXPECT_THAT(csv, HasSubstr("\nstrong,isolated,8,3.0000,2.0000,0.5000,3.5000,1.5000,head,512,256,"
                             "65,33,17,3\n"));
  EXPECT_THAT(csv, HasSubstr("\nweak,wall,2,"));
}

TEST(ScalingTable, NobodyDrawsIsEven) {
  EXPECT_EQ(row("strong", 4, 0, 0, 0).imbalance(), 1);
}

TEST(ScalingTable, SummaryTellsImbalanceOfEightRanks) {
  std::vector rows{row("strong", 4, 9, 1, 0), row("strong", 8, 3, 2, 0.5),
                   row("lum-ma", 8, 5, 4, 0)};
  rows.push_back(row("strong", 8, 7, 1, 0));
  rows.back().isIsolated = false;
  const std::string summary = scalingSummary(rows);
  EXPECT_THAT(summary, HasSubstr("8 ranks, strong head: slowest / mean 1.500\n"));
  EXPECT_THAT(summary, HasSubstr("8 ranks, lum-ma head: slowest / mean 1.250\n"));
  EXPECT_THAT(summary, Not(HasSubstr("9.000")));
  EXPECT_THAT(summary, Not(HasSubstr("7.000")));
}

// Strong: 10 ms to 2 ms on 8 ranks, 5 times of 8. Weak: 10 ms to 12.5 ms.
TEST(ScalingTable, SummaryTellsWhatTheMostRanksGain) {
  const std::vector rows{row("strong", 8, 1.5, 1, 0.5), row("strong", 1, 10, 10, 0),
                         row("weak", 1, 10, 10, 0), row("weak", 4, 12, 10, 0.5)};
  const std::string summary = scalingSummary(rows);
  EXPECT_THAT(summary, HasSubstr("8 ranks: 5.00 times as fast as one, 62.5 % of the ideal"));
  EXPECT_THAT(summary, HasSubstr("4 ranks: 1.250 of one rank's time"));
}

TEST(ScalingTable, PlotsHaveADiagramPerKind) {
  std::vector rows{row("strong", 8, 3, 2, 0.5)};
  EXPECT_THAT(scalingTablePlots(rows), HasSubstr("layout 1,1"));
  EXPECT_THAT(scalingTablePlots(rows), Not(HasSubstr("'wall'")));
  rows.push_back(row("weak", 8, 3, 2, 0.5));
  rows.back().isIsolated = false;
  EXPECT_THAT(scalingTablePlots(rows), HasSubstr("of('weak','wall')"));
  EXPECT_EQ(scalingTablePlots({}), "");
}

TEST(ScalingScenes, WeakVolumesAreAsCubicAsTheRanksAllow) {
  const auto parts = [](int ranks) { return (weakDims(10, ranks) - 1) / 10; };
  EXPECT_EQ(parts(1), glm::ivec3(1, 1, 1));
  EXPECT_EQ(parts(2), glm::ivec3(2, 1, 1));
  EXPECT_EQ(parts(7), glm::ivec3(7, 1, 1));
  EXPECT_EQ(parts(8), glm::ivec3(2, 2, 2));
  EXPECT_EQ(parts(27), glm::ivec3(3, 3, 3));
  EXPECT_EQ(parts(64), glm::ivec3(4, 4, 4));
  EXPECT_EQ(parts(256), glm::ivec3(8, 8, 4));
}

}  // namespace
}  // namespace burin::host::bench
