// All pairs of pixel types, schedules, transfers, ranks, sizes and active fractions.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "all_pairs.hpp"
#include "covering_in_process.hpp"

namespace burin::compositor {
namespace {

using test::Drawn;
using test::FrameRow;
using test::Levels;
using test::PixelType;
using test::Transfers;

TEST(AllPairs, MeetInFewRows) {
  const Levels counts{9, 5, 3, 17, 4, 5};
  // No large first, fourth and fifth level at once.
  const auto isAllowed = [](const Levels& row) { return row[0] * row[3] * row[4] <= 200; };
  const auto rows = test::AllPairs{counts, isAllowed, 1}.rows();
  EXPECT_TRUE(std::ranges::all_of(rows, isAllowed));
  EXPECT_LE(rows.size(), 2U * 9 * 17);  // 9 x 17 pairs are in as many rows at least
  for (std::size_t f = 0; f < counts.size(); ++f) {
    for (std::size_t g = 0; g < f; ++g) {
      for (int a = 0; a < counts[f]; ++a) {
        for (int b = 0; b < counts[g]; ++b) {
          EXPECT_TRUE(std::ranges::any_of(
              rows, [&](const Levels& row) { return row[f] == a && row[g] == b; }));
        }
      }
    }
  }
}

std::vector<FrameRow> manyRows() {
  std::vector<int> ranks(16);
  std::iota(ranks.begin(), ranks.end(), 1);
  ranks.push_back(24);
  return test::coveringRows({ranks, {{1, 1}, {997, 1}, {509, 503}, {1024, 1024}}, 3e8});
}

/// Frames of 2048 x 2048 pixels.
std::vector<FrameRow> largeRows() {
  std::vector<FrameRow> rows;
  for (const int ranks : {2, 3, 8}) {
    for (const PixelType pixel : {PixelType::kOver, PixelType::kSilhouette}) {
      const bool isLean = ranks < 8 || pixel == PixelType::kSilhouette;
      rows.push_back({pixel,
                      std::nullopt,
                      isLean ? Transfers::kByReference : Transfers::kByValue,
                      ranks,
                      {2048, 2048},
                      Drawn::kHalf,
                      1});
    }
  }
  return rows;
}

class CoveringArray : public testing::TestWithParam<FrameRow> {};

TEST_P(CoveringArray, EqualsTheSerialCombination) {
  test::expectSerialCombination(GetParam());
}

constexpr auto kName = [](const auto& row) { return test::nameOf(row.param); };
INSTANTIATE_TEST_SUITE_P(, CoveringArray, testing::ValuesIn(manyRows()), kName);
INSTANTIATE_TEST_SUITE_P(Large, CoveringArray, testing::ValuesIn(largeRows()), kName);

}  // namespace
}  // namespace burin::compositor
