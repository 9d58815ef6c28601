#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
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

TEST(BenchCompositing, FolderThatCannotBe) {
  const TemporaryFolder folder;
  const std::string file = folder.write("file", "");
  const auto run = runBurin({"bench", "compositing", "--quick", "--out", file}, 2);
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_THAT(test::onlyLine(run.err), HasSubstr(file));
}

}  // namespace
}  // namespace burin
