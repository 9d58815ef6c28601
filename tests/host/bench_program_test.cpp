#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "host/program.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

using test::runBurin;
using test::TemporaryFolder;
using ::testing::HasSubstr;

using Line = std::map<std::string, std::string>;

std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream in{line};
  for (std::string cell; std::getline(in, cell, ',');) all.push_back(cell);
  return all;
}

/// The lines of a CSV file by column name.
std::vector<Line> readCsv(const std::string& file) {
  std::ifstream in{file};
  std::string text;
  std::getline(in, text);
  const auto header = cells(text);
  std::vector<Line> lines;
  while (std::getline(in, text)) {
    const auto values = cells(text);
    EXPECT_EQ(values.size(), header.size()) << text;
    Line line;
    for (std::size_t i = 0; i < std::min(values.size(), header.size()); ++i)
      line[header[i]] = values[i];
    lines.push_back(line);
  }
  return lines;
}

// Whoever composites, with IceT or without: every frame of the table is right.
TEST(BenchCompositing, WritesATableOfRightFrames) {
  const TemporaryFolder folder;
  const auto run = runBurin({"bench", "compositing", "--quick", "--sizes", "64", "--repeats", "1",
                             "--out", folder / "out"},
                            3);
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const auto lines = readCsv(folder / "out/compositing.csv");
  std::map<std::string, int> burins;
  for (const Line& line : lines) {
    EXPECT_EQ(line.at("pixel"), "rgba-float");
    EXPECT_EQ(line.at("network"), "shm");
    EXPECT_EQ(line.at("width"), "64");
    EXPECT_LE(std::stod(line.at("error_max")), 1e-5) << line.at("schedule");
    EXPECT_GT(std::stod(line.at("median_ms")), 0);
    EXPECT_LE(std::stoll(line.at("bytes_compose")), std::stoll(line.at("bytes_total")));
    if (line.at("peer") == "burin" && line.at("schedule") == "swap")
      ++burins[line.at("case") + " " + line.at("ranks")];
  }
  for (const char* input : {"vessels", "ct-phantom", "dense"}) {
    for (const char* ranks : {" 2", " 3"}) EXPECT_EQ(burins[std::string{input} + ranks], 1);
  }
  EXPECT_THAT(run.out, HasSubstr("3 ranks"));
}

// Whatever the times are: skipping visits fewer samples and shades the same ones.
TEST(BenchSkip, WritesATableInWhichSkippingSkips) {
  const TemporaryFolder folder;
  const auto run = runBurin({"bench", "skip", "--quick", "--size", "24", "--out", folder / "out"});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const auto lines = readCsv(folder / "out/skip.csv");
  ASSERT_EQ(lines.size(), 12u);
  for (std::size_t i = 0; i < lines.size(); i += 2) {
    const Line& on = lines[i];
    const Line& off = lines[i + 1];
    SCOPED_TRACE(on.at("scene") + " " + on.at("visible_fraction"));
    EXPECT_EQ(on.at("skip"), "on");
    EXPECT_EQ(off.at("skip"), "off");
    EXPECT_EQ(on.at("scene"), off.at("scene"));
    EXPECT_EQ(on.at("samples_shaded"), off.at("samples_shaded"));
    EXPECT_LE(std::stoll(on.at("samples_visited")), std::stoll(off.at("samples_visited")));
    EXPECT_GT(std::stod(on.at("median_ms")), 0);
    EXPECT_GT(std::stod(on.at("ratio_to_dense")), 0);
  }
  EXPECT_EQ(lines[0].at("scene"), "ball");
  EXPECT_NEAR(std::stod(lines[0].at("visible_fraction")), 0.01, 0.001);
  EXPECT_EQ(lines[10].at("scene"), "dense");
  EXPECT_EQ(std::stod(lines[10].at("visible_fraction")), 1);
  EXPECT_THAT(run.out, HasSubstr("one ball of 1 %"));
}

// A user's scene has nothing to be compared with.
TEST(BenchSkip, TakesAScene) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("a scene.json", R"({ "schema_version": 1,
    "volume": { "procedural": "shells", "dims": [24, 24, 24], "type": "u8" },
    "image": { "size": [32, 32] },
    "layers": [{ "transfer_function": { "points": [
      { "value": 100, "color": "#8f1d18", "opacity": 0 },
      { "value": 255, "color": "#d8473a", "opacity": 0.5 }] } }] })");
  const auto run = runBurin({"bench", "skip", scene, "--quick", "--out", folder / "out"}, 2);
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const auto lines = readCsv(folder / "out/skip.csv");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].at("scene"), "a_scene");
  EXPECT_EQ(lines[0].at("ratio_to_dense"), "");
}

TEST(BenchScaling, WritesATableOfAllKinds) {
  const TemporaryFolder folder;
  const auto run = runBurin({"bench", "scaling", "--quick", "--size", "16", "--bricks", "1,3",
                             "--repeats", "1", "--out", folder / "out"},
                            2);
  ASSERT_EQ(run.exitCode, 0) << run.err;
  std::map<std::string, int> rows;
  for (const Line& line : readCsv(folder / "out/scaling.csv")) {
    SCOPED_TRACE(line.at("kind") + " " + line.at("mode") + " " + line.at("ranks"));
    ++rows[line.at("kind") + " " + line.at("mode") + " " + line.at("ranks")];
    const double slowest = std::stod(line.at("render_max_ms"));
    EXPECT_GT(slowest, 0);
    EXPECT_LE(std::stod(line.at("render_mean_ms")), slowest);
    EXPECT_GE(std::stod(line.at("composite_ms")), 0);
    EXPECT_GE(std::stod(line.at("imbalance")), 1);
  }
  for (const char* row : {"strong wall 1", "strong isolated 1", "strong isolated 3",
                          "weak isolated 1", "weak isolated 3"})
    EXPECT_EQ(rows[row], 1) << row;
  EXPECT_EQ(rows["lum-ma isolated 8"], 2);
  EXPECT_THAT(run.out, HasSubstr("8 ranks, lum-ma two-layers"));
}

// 2 x 2 x 4 cells.
TEST(BenchScaling, MoreBricksThanTheVolumeHas) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("small.json", R"({ "schema_version": 1,
    "volume": { "procedural": "ramp", "dims": [3, 3, 5], "type": "u8" },
    "image": { "size": [16, 16] },
    "layers": [{ "transfer_function": { "points": [
      { "value": 0, "color": "#8f1d18", "opacity": 0 },
      { "value": 255, "color": "#d8473a", "opacity": 0.5 }] } }] })");
  const auto run = runBurin(
      {"bench", "scaling", scene, "--bricks", "16,17", "--repeats", "1", "--out", folder / "out"});
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_THAT(test::onlyLine(run.err), HasSubstr("--bricks 17: the volume makes 16 bricks"));
}

TEST(BenchCompositing, FolderThatCannotBe) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "");
  const auto run = runBurin({"bench", "compositing", "--quick", "--out", file}, 2);
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_THAT(test::onlyLine(run.err), HasSubstr(file));
}

// Whatever the times are: with all lanes busy every ray takes as many samples and shades all of
// them.
TEST(BenchRates, WritesATableInWhichBusyLanesAreBusy) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("shells.json", R"({ "schema_version": 1,
    "volume": { "procedural": "shells", "dims": [24, 16, 20], "type": "u8" },
    "layers": [{ "transfer_function": { "points": [
      { "value": 100, "color": "#8f1d18", "opacity": 0 },
      { "value": 255, "color": "#d8473a", "opacity": 0.9 }], "opacity_unit_length": 0.1 } }] })");
  const auto run =
      runBurin({"bench", "rates", scene, "--quick", "--size", "64", "--out", folder / "out"}, 1);
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const auto lines = readCsv(folder / "out/rates.csv");
  ASSERT_EQ(lines.size(), 4u);
  std::map<std::string, std::int64_t> visited;
  for (const Line& line : lines) {
    SCOPED_TRACE(line.at("look") + " " + line.at("style"));
    const auto number = [&](const char* column) { return std::stoll(line.at(column)); };
    EXPECT_EQ(line.at("scene"), "shells");
    EXPECT_EQ(number("busy_samples_visited"), number("busy_samples_shaded"));
    // 19 cells at half a voxel: 38 segments, and one more where no plane lies on a face.
    const auto segments = number("busy_samples_visited") / number("busy_pixels");
    EXPECT_EQ(number("busy_samples_visited") % number("busy_pixels"), 0);
    EXPECT_TRUE(segments == 38 || segments == 39) << segments;
    EXPECT_LE(number("samples_in_occupied_cells"), number("samples_visited"));
    EXPECT_LT(number("samples_shaded"), number("samples_visited"));
    EXPECT_GT(std::stod(line.at("ratio")), 0);
    visited[line.at("look")] = number("samples_visited");
  }
  EXPECT_LT(visited.at("opaque"), visited.at("translucent"));  // rays end
  EXPECT_THAT(run.out, HasSubstr("translucent: samples visited / shaded"));
}

TEST(BenchRates, FixedStepsOnly) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("s.json", R"({ "schema_version": 1,
    "volume": { "procedural": "shells", "dims": [8, 8, 8] }, "quality": { "max_error": 0.01 },
    "layers": [{ "transfer_function": { "points": [
      { "value": 0, "color": "#8f1d18", "opacity": 0.5 }] } }] })");
  const auto run = runBurin({"bench", "rates", scene, "--out", folder / "out"}, 2);
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_THAT(test::onlyLine(run.err), HasSubstr("max_error"));
}

// They are images of their own, of which those that draw by themselves would take the first alone.
TEST(BenchPrograms, RefuseProjections) {
  const TemporaryFolder folder;
  std::ofstream{folder / "s.json"} << R"({ "schema_version": 1,
    "volume": { "procedural": "shells", "dims": [8, 8, 8] },
    "layers": [{ "mode": "mip", "transfer_function": { "points": [
      { "value": 0.1, "color": "#fff", "opacity": 1 }] } }] })";
  for (const char* bench : {"compositing", "skip", "scaling", "rates"}) {
    SCOPED_TRACE(bench);
    const auto run =
        runBurin({"bench", bench, folder / "s.json", "--quick", "--out", folder / "out"}, 2);
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_THAT(test::onlyLine(run.err), HasSubstr("not projections"));
  }
}

TEST(BenchAccuracy, WritesATableWhoseErrorsFallWithTheStep) {
  const TemporaryFolder folder;
  const std::string scene = folder / "ramp.json";
  std::ofstream{scene} << R"({ "schema_version": 1,
    "volume": { "procedural": "shells", "dims": [16, 16, 16] },
    "layers": [ { "name": "a", "transfer_function": { "points": [
      { "value": 0.2, "color": "#204080", "opacity": 0 },
      { "value": 0.9, "color": "#f0e0a0", "opacity": 0.4 } ] } } ] })";
  const auto run =
      runBurin({"bench", "accuracy", scene, "--quick", "--size", "16", "--out", folder / "out"}, 1);
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const auto lines = readCsv(folder / "out/accuracy.csv");
  ASSERT_EQ(lines.size(), 21);
  std::map<std::string, double> slices;  // error at step 1 by precision
  double rays = 0;
  double coarsest = 0;
  double finest = 0;
  for (const Line& line : lines) {
    EXPECT_EQ(line.at("scene"), "ramp");
    EXPECT_GT(std::stod(line.at("samples_visited")), 0);
    const double error = std::stod(line.at("error_max"));
    if (line.at("technique") == "slices") {
      slices[line.at("precision")] = error;
      continue;
    }
    EXPECT_EQ(line.at("precision"), "float");
    if (line.at("step_voxels") == "1" && line.at("preintegrated") == "1") rays = error;
    if (line.at("step_voxels") == "4") coarsest = std::max(coarsest, error);
    if (line.at("step_voxels") == "0.125") finest = std::max(finest, error);
    if (line.at("max_error_asked") != "0") {
      EXPECT_LE(error, std::stod(line.at("max_error_asked")));
    }
  }
  ASSERT_EQ(slices.size(), 3);
  EXPECT_NEAR(slices["float"], rays, 1.1e-4);  // the same samples, but rays end at 1e-4
  EXPECT_GT(std::abs(slices["byte"] - slices["float"]), 1e-3);  // for better or worse at this step
  EXPECT_GT(coarsest, 20 * finest);  // second order would be a factor of 1000
  EXPECT_GT(finest, 0);
}

TEST(BenchMaxError, WritesARowForEachPicture) {
  const TemporaryFolder folder;
  const std::string volume = folder / "ramp_10x12x11_f32.raw";
  ASSERT_EQ(
      runBurin({"make-volume", "ramp", "--dims", "10,12,11", "--type", "f32", "-o", volume}, 1)
          .exitCode,
      0);
  const auto run = runBurin({"bench", "max-error", volume, "--quick", "--size", "12",
                             "--smallest-step", "0.25", "--out", folder / "out"},
                            1);
  ASSERT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("6 of 6 pictures keep what was asked"));
  const auto lines = readCsv(folder / "out/max_error.csv");
  ASSERT_EQ(lines.size(), 6);
  std::map<std::string, int> functions;
  for (const Line& line : lines) {
    EXPECT_EQ(line.at("volume"), "ramp_10x12x11_f32");
    ++functions[line.at("function")];
    const double asked = std::stod(line.at("max_error_asked"));
    EXPECT_LE(std::stod(line.at("error_max")), asked);
    EXPECT_LE(std::stod(line.at("truth_change")), 0.1 / 512);
    EXPECT_GT(std::stod(line.at("samples_visited")), 0);
    const double step = std::stod(line.at("as_asked_step"));  // 0 if none
    EXPECT_TRUE(step == 0 || (step >= 0.25 && step <= 4)) << step;
    EXPECT_EQ(step == 0, std::stod(line.at("as_asked_samples")) == 0);
    EXPECT_LE(std::stod(line.at("as_good_step")), step);  // what was asked takes no more
  }
  EXPECT_EQ(functions, (std::map<std::string, int>{{"smooth", 3}, {"spiky", 3}}));
}

TEST(BenchMaxError, VolumeThatIsNotThere) {
  const TemporaryFolder folder;
  const auto run =
      runBurin({"bench", "max-error", folder / "none.nrrd", "--quick", "--out", folder / "out"}, 1);
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_THAT(test::onlyLine(run.err), HasSubstr("none.nrrd"));
}

}  // namespace
}  // namespace burin
