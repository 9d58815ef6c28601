#include "bench/skip_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "bench/ball_volume.hpp"

namespace burin::host::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

SkipMeasurement row(std::string scene, double fraction, bool isSkipping, double ratio) {
  SkipMeasurement measured;
  measured.scene = std::move(scene);
  measured.visibleFraction = fraction;
  measured.isSkipping = isSkipping;
  measured.repeats = 5;
  measured.medianMs = 2;
  measured.smallestMs = 1;
  measured.largestMs = 4;
  measured.samplesVisited = 1040;
  measured.samplesInOccupiedCells = 1000;
  measured.samplesShaded = 800;
  measured.leaps = 7;
  measured.ratioToDense = ratio;
  return measured;
}

// Scripts rely on the first six columns.
TEST(SkipTable, CsvHasTheContractsColumns) {
  const std::vector rows{row("ball", 0.01, true, 0.05), row("mine", 0.5, false, 0)};
  const std::string csv = skipCsv(rows);
  EXPECT_THAT(csv, StartsWith("scene,visible_fraction,skip,median_ms,samples_visited,"
                              "samples_shaded,"));
  EXPECT_THAT(csv, HasSubstr("\nball,0.01,on,2.0000,1040,800,1000,7,0.05000,1.0000,4.0000,,5\n"));
  EXPECT_THAT(csv, HasSubstr("\nmine,0.5,off,2.0000,1040,800,1000,7,,1.0000,4.0000,,5\n"));
}

// The rows with 1 % of the voxels and skipping on count, and no others.
TEST(SkipTable, TargetsAreTakenFromTheirScenes) {
  const std::vector rows{row("ball", 0.25, true, 0.5), row("ball", 0.0101, false, 0.9),
                         row("ball", 0.0101, true, 0.0525), row("balls", 0.0099, true, 0.135)};
  const std::string text = skipTargets(rows);
  EXPECT_THAT(text, HasSubstr("0.0525   target 0.08  met"));
  EXPECT_THAT(text, HasSubstr("0.1350   target 0.12  missed"));
  EXPECT_THAT(text, HasSubstr("1.0400   target 1.05  met"));
  EXPECT_THAT(text, HasSubstr("1.3000\n"));
}

TEST(SkipTable, EditsAreToldWhereTheyWereMeasured) {
  std::vector rows{row("ball", 0.01, true, 0.05), row("balls", 0.01, true, 0.05)};
  EXPECT_THAT(skipTargets(rows), Not(HasSubstr("edit")));
  rows[0].editMs = 51.5;
  rows[1].editMs = 12.25;
  EXPECT_THAT(skipCsv(rows), HasSubstr("4.0000,51.5000,5\n"));
  EXPECT_THAT(skipLine(rows[1], row("balls", 0.01, false, 0)), HasSubstr("edit 12.2 ms"));
  EXPECT_THAT(skipTargets(rows), HasSubstr("51.5000   target 50    missed"));
}

TEST(SkipTable, TargetsWithoutMeasurementsAreLeftOut) {
  const std::vector rows{row("mine", 0.01, true, 0)};
  EXPECT_THAT(skipTargets(rows), Not(HasSubstr("dense")));
  EXPECT_EQ(skipTargets({}), "");
}

TEST(SkipTable, PlotsHaveACurvePerSceneAndSetting) {
  const std::vector rows{row("ball", 0.01, true, 0.05), row("ball", 0.01, false, 0.05),
                         row("mine", 0.5, true, 0)};
  const std::string script = skipPlots(rows);
  for (const char* curve : {"of('ball','on')", "of('ball','off')", "of('mine','on')"})
    EXPECT_THAT(script, HasSubstr(curve));
}

std::vector<std::byte> voxelsOf(node::BrickSource& source) {
  std::vector<std::byte> voxels(source.info().bytes());
  source.load({glm::ivec3{0}, source.info().grid.dims}, voxels);
  return voxels;
}

std::ptrdiff_t visible(const std::vector<std::byte>& voxels) {
  return std::ssize(voxels) - std::ranges::count(voxels, std::byte{0});
}

// Voxels at equal distances come in or stay out together: at most 48 around one centre.
TEST(BallVolume, HoldsTheFractionAskedFor) {
  for (const int count : {1, 30}) {
    for (const double fraction : {0.01, 0.25}) {
      const auto voxels = voxelsOf(*makeBalls(count, fraction, 40));
      EXPECT_NEAR(static_cast<double>(visible(voxels)), fraction * 40 * 40 * 40, 192)
          << count << " balls, " << fraction;
    }
  }
}

TEST(BallVolume, AFractionOfOneIsAllOfIt) {
  const auto voxels = voxelsOf(*makeBalls(1, 1, 16));
  EXPECT_EQ(std::ranges::count(voxels, std::byte{255}), std::ssize(voxels));
}

}  // namespace
}  // namespace burin::host::bench
