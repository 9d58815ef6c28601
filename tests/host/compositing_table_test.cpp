#include "bench/compositing_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <sstream>

namespace burin::host::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

CompositingMeasurement row(std::string peer, std::string schedule, int ranks, double ms,
                           std::int64_t compose, std::int64_t total,
                           std::string input = "vessels") {
  CompositingMeasurement measured;
  measured.peer = std::move(peer);
  measured.schedule = std::move(schedule);
  measured.ranks = ranks;
  measured.frame = {512, 256};
  measured.activeFraction = 0.125;
  measured.input = std::move(input);
  measured.repeats = 9;
  measured.medianMs = ms;
  measured.smallestMs = ms / 2;
  measured.largestMs = 2 * ms;
  measured.bytesCompose = compose;
  measured.bytesTotal = total;
  measured.largestError = 1.5e-7;
  return measured;
}

// Scripts rely on the first eleven columns.
TEST(CompositingTable, CsvHasTheContractsColumns) {
  const std::vector rows{row("icet", "radix-k", 4, 1.25, 1000, 3000)};
  const std::string csv = compositingCsv(rows, "100mbit");
  EXPECT_THAT(csv, StartsWith("peer,pixel,schedule,ranks,width,height,active_fraction,network,"
                              "median_ms,bytes_compose,bytes_total,"));
  EXPECT_THAT(csv, HasSubstr("\nicet,rgba-float,radix-k,4,512,256,0.125,100mbit,1.2500,1000,3000,"
                             "vessels,0.6250,2.5000,9,1.5e-07,NaN\n"));
}

/// The numbers of the summary's line that begins with `kind` and `schedule`.
std::vector<double> figures(const std::string& text, const std::string& kind,
                            const std::string& schedule) {
  std::istringstream lines{text};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words{line};
    std::string first, second;
    if (!(words >> first >> second) || first != kind || second != schedule) continue;
    return {std::istream_iterator<double>{words}, std::istream_iterator<double>{}};
  }
  return {};
}

// Case one: burin 1 ms against 2 (bswap) and 4 (tree, fewer bytes); case two: 8 ms against 4.
TEST(CompositingTable, SummaryComparesWithTheBestOfEachCase) {
  const std::vector rows{row("burin", "swap", 2, 1, 100, 200), row("icet", "bswap", 2, 2, 400, 800),
                         row("icet", "tree", 2, 4, 50, 50),    row("burin", "swap", 4, 8, 100, 200),
                         row("icet", "bswap", 4, 4, 100, 200), row("icet", "tree", 4, 8, 200, 400)};
  EXPECT_THAT(
      figures(compositingSummary(rows), "sparse", "swap"),
      testing::ElementsAre(2, 1.0, 2.0, 0.5, 0.5, testing::DoubleNear(std::sqrt(2), 1e-3), 2.0));
}

// "direct" is IceT's fastest here, but no single-image strategy.
TEST(CompositingTable, SummaryTellsSingleImageStrategiesFromAll) {
  const std::vector rows{row("burin", "swap", 2, 2, 1, 1), row("icet", "bswap", 2, 4, 1, 1),
                         row("icet", "direct", 2, 1, 1, 1)};
  const std::string summary = compositingSummary(rows);
  const auto all = summary.find("burin / IceT's best,");
  ASSERT_NE(all, std::string::npos);
  EXPECT_THAT(summary, StartsWith("burin / IceT's best single-image strategy,"));
  EXPECT_EQ(figures(summary, "sparse", "swap").at(1), 0.5);
  EXPECT_EQ(figures(summary.substr(all), "sparse", "swap").at(1), 2.0);
}

TEST(CompositingTable, KindsOfInputStayApart) {
  const std::vector rows{row("burin", "swap", 2, 1, 1, 1), row("icet", "tree", 2, 2, 1, 1),
                         row("burin", "swap", 2, 3, 1, 1, "dense"),
                         row("icet", "tree", 2, 1, 1, 1, "dense")};
  const std::string summary = compositingSummary(rows);
  EXPECT_EQ(figures(summary, "sparse", "swap").at(1), 0.5);
  EXPECT_EQ(figures(summary, "dense", "swap").at(1), 3.0);
}

// Linear in the logarithm: 4 ranks 2 ms, 8 ranks 4 ms, so 6 ranks 2 + 2 log2(6/4) = 3.170 ms.
TEST(CompositingTable, SummaryInterpolatesBetweenPowersOfTwo) {
  const std::vector rows{row("burin", "swap", 4, 2, 1, 1), row("burin", "swap", 6, 6.34, 1, 1),
                         row("burin", "swap", 8, 4, 1, 1)};
  const std::string summary = compositingSummary(rows);
  EXPECT_THAT(summary, Not(HasSubstr("IceT")));
  EXPECT_THAT(figures(summary, "sparse", "swap"), testing::ElementsAre(1, 2.0, 2.0));
}

TEST(CompositingTable, CaseLineNamesTheFastest) {
  const std::vector rows{row("burin", "swap", 2, 3, 1, 1), row("burin", "direct", 2, 1, 1, 1),
                         row("icet", "bswap", 2, 4, 1, 1), row("icet", "tree", 2, 5, 1, 1)};
  const std::string line = caseLine(rows);
  EXPECT_THAT(line, HasSubstr("burin direct "));
  EXPECT_THAT(line, HasSubstr("IceT bswap "));
  EXPECT_THAT(line, HasSubstr(" 0.250\n"));
}

}  // namespace
}  // namespace burin::host::bench
