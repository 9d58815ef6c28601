#include "burin/host/histogram.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "burin/host/gradient_histogram.hpp"
#include "support/array_source.hpp"
#include "support/mpi_test.hpp"

namespace burin::host {
namespace {

using test::ArraySource;
using test::world;
using ::testing::Each;
using ::testing::HasSubstr;

VolumeGrid gridOf(const glm::ivec3& dims) {
  VolumeGrid grid;
  grid.dims = dims;
  return grid;
}

Histogram histogramOf(ArraySource source) {
  return computeHistogram(world(), source, node::surveyVolume(world(), source, {}));
}

TEST(Histogram, CountsEachValueOfAByteVolume) {
  // Value x + 20 (y + 3z) mod 7: counted here once more, without slabs or ranks.
  const auto value = [](glm::ivec3 p) {
    return static_cast<std::uint8_t>(p.x + 20 * ((p.y + 3 * p.z) % 7));
  };
  const glm::ivec3 dims{5, 6, 11};
  std::vector<std::int64_t> expected(125);  // 0 … 124
  for (int z = 0; z < dims.z; ++z)
    for (int y = 0; y < dims.y; ++y)
      for (int x = 0; x < dims.x; ++x) ++expected[value({x, y, z})];
  const auto histogram =
      histogramOf(ArraySource::of<std::uint8_t>(gridOf(dims), node::VoxelType::kU8, value));
  EXPECT_EQ(histogram.binWidth, 1);
  EXPECT_EQ(histogram.lowest, 0);
  EXPECT_EQ(histogram.highest, 124);
  EXPECT_EQ(histogram.counts, expected);
}

TEST(Histogram, WideIntegersShareBinsEvenly) {
  // Every value of -8192 … 8191 once: 16384 values in 1024 bins of 16.
  const auto histogram = histogramOf(ArraySource::of<std::int16_t>(
      gridOf({128, 16, 8}), node::VoxelType::kI16,
      [](glm::ivec3 p) { return static_cast<std::int16_t>(p.x + 128 * (p.y + 16 * p.z) - 8192); }));
  EXPECT_EQ(histogram.lowest, -8192);
  EXPECT_EQ(histogram.binWidth, 16);
  EXPECT_EQ(histogram.counts.size(), 1024u);
  EXPECT_THAT(histogram.counts, Each(16));
}

TEST(Histogram, FloatsLeaveOutWhatIsNotFinite) {
  const auto histogram = histogramOf(ArraySource{gridOf({4, 4, 4}), [](glm::ivec3 p) {
                                                   if (p.x == 3 && p.y == 0) return NAN;
                                                   if (p.x == 3 && p.y == 1) return INFINITY;
                                                   return static_cast<float>(p.x);
                                                 }});
  EXPECT_EQ(histogram.total(), 64 - 8);
  EXPECT_EQ(histogram.counts.front(), 16);
  EXPECT_EQ(histogram.counts.back(), 8);  // the largest value belongs to the last bin
}

TEST(Histogram, ConstantVolumeHasOneBin) {
  const auto histogram = histogramOf(ArraySource{gridOf({3, 3, 3}), [](glm::ivec3) { return 7; }});
  EXPECT_THAT(histogram.counts, ::testing::ElementsAre(27));
  EXPECT_TRUE(std::isfinite(otsuThreshold(histogram)));
  EXPECT_GT(quantileAbove(histogram, histogram.lowest, 0.99), histogram.lowest);
}

TEST(Histogram, OtsuPartsTwoHeaps) {
  Histogram histogram;
  histogram.lowest = 100;
  histogram.binWidth = 2;
  histogram.counts = {900, 950, 800, 0, 0, 0, 0, 40, 60, 30};
  // Any threshold in the gap gives the same classes; the first is the lower edge of bin 3.
  EXPECT_EQ(otsuThreshold(histogram), 106);
}

TEST(Histogram, QuantileLooksOnlyAbove) {
  Histogram histogram;
  histogram.counts = {1000, 1000, 50, 49, 1};
  EXPECT_EQ(quantileAbove(histogram, 2, 0.5), 3);
  EXPECT_EQ(quantileAbove(histogram, 2, 0.99), 4);
  EXPECT_EQ(quantileAbove(histogram, 2, 1), 5);
  EXPECT_EQ(quantileAbove(histogram, 0, 0.3), 1);
}

TEST(HistogramText, DrawsLogarithmicBars) {
  Histogram histogram;
  histogram.lowest = 0;
  histogram.highest = 3;
  histogram.counts = {9999, 99, 0, 1};  // log1p: 1, ½, 0, 0.075 of the tallest
  EXPECT_EQ(drawHistogram(histogram, 4, 2), "  █   \n  ██ ▁\n  0  3\n");
}

TEST(HistogramText, JoinsBinsIntoColumns) {
  Histogram histogram;
  histogram.highest = 255;
  histogram.counts.assign(256, 5);
  const std::string text = drawHistogram(histogram, 64, 1);
  std::string bar = "  ";
  for (int i = 0; i < 64; ++i) bar += "█";
  EXPECT_THAT(text, HasSubstr(bar + "\n"));
}

/// A ramp of 41 bytes along x that is four times as steep from voxel 30 on; spacing 2 along x.
GradientHistogram bentRampHistogram() {
  VolumeGrid grid = gridOf({41, 5, 7});
  grid.spacing = {2, 1, 1};
  const auto value = [](glm::ivec3 p) {
    return static_cast<std::uint8_t>(std::min(p.x, 30) + 4 * std::max(p.x - 30, 0));
  };
  ArraySource source = ArraySource::of<std::uint8_t>(grid, node::VoxelType::kU8, value);
  const auto survey =
      node::surveyVolume(world(), source, {GradientOperatorSet{GradientOperator::kCentral}});
  return computeGradientHistogram(world(), source, survey);
}

TEST(GradientHistogram, CountsValuesByTheirGradients) {
  const GradientHistogram histogram = bentRampHistogram();
  EXPECT_NEAR(histogram.scale, 2, 2 * 0x1p-10);  // the steep part, to the survey's bins
  ASSERT_EQ(histogram.values.counts.size(), 71u);
  EXPECT_EQ(histogram.values.total(), 41 * 5 * 7);
  // A quarter of the scale between the ends, an eighth at the first voxel, which lacks a neighbour,
  // and 5/8 at the bend. The scale is an upper edge: rows are those of a little less.
  const int rows[] = {15, 31, 79, 127};
  for (std::size_t value = 0; value < 71; ++value)
    for (int row = 0; row < kGradientRows; ++row) {
      const bool isVoxel = value <= 30 || (value - 30) % 4 == 0;
      const int own = value == 0 ? 0 : value < 30 ? 1 : value == 30 || value == 70 ? 2 : 3;
      const int expectedRow = value == 70 ? 63 : rows[own];
      EXPECT_EQ(histogram.at(row, value), isVoxel && row == expectedRow ? 5 * 7 : 0)
          << value << " " << row;
    }
}

TEST(GradientHistogram, IsDrawnWithItsAxes) {
  const GradientHistogram histogram = bentRampHistogram();
  const DisplayPicture picture = drawGradientHistogram(histogram);
  ASSERT_EQ(picture.bytes.size(), 3 * picture.size.pixels());
  const auto shade = [&](int x, int y) {
    return int{
        picture
            .bytes[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.size.width) +
                        static_cast<std::size_t>(x))]};
  };
  // The plot's left axis is the longest run of ink in any column, the lower one in any row.
  int left = 0, bottom = 0, longest = 0, widest = 0;
  for (int x = 0; x < picture.size.width; ++x) {
    int run = 0;
    for (int y = 0; y < picture.size.height; ++y) {
      run = shade(x, y) < 64 ? run + 1 : 0;
      if (run > longest) {
        longest = run;
        left = x;
      }
    }
  }
  for (int y = 0; y < picture.size.height; ++y) {
    int run = 0;
    for (int x = 0; x < picture.size.width; ++x) {
      run = shade(x, y) < 64 ? run + 1 : 0;
      if (run > widest) {
        widest = run;
        bottom = y;
      }
    }
  }
  EXPECT_GE(longest, 3 * kGradientRows);
  ASSERT_GE(widest, 71 * 10);
  // All counts are alike, so cells are ink or paper: value 20 at row 31, nothing above it.
  const int column = left + 1 + 20 * 10 + 5;
  EXPECT_LT(shade(column, bottom - 3 * 31 - 1), 64);
  EXPECT_EQ(shade(column, bottom - 3 * 40 - 1), 255);
}

}  // namespace
}  // namespace burin::host
