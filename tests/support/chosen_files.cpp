#include "support/chosen_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

namespace burin::test {

namespace {

using Names = std::set<std::string>;

std::string fileName(std::string_view path) {
  return std::filesystem::path{path}.filename().string();
}

std::optional<Names> chosenFiles(int argc, const char* const* argv) {
  constexpr std::string_view kOption = "--files=";
  for (int i = 1; i < argc; ++i) {
    std::string_view list = argv[i];
    if (!list.starts_with(kOption)) continue;
    list.remove_prefix(kOption.size());
    Names files;
    while (!list.empty()) {
      const std::size_t end = std::min(list.find(':'), list.size());
      files.insert(fileName(list.substr(0, end)));
      list.remove_prefix(std::min(end + 1, list.size()));
    }
    return files;
  }
  return std::nullopt;
}

struct Cases {
  Names chosen, others;
};

Cases casesByFile(const Names& files) {
  Cases cases;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int j = 0; j < suite.total_test_count(); ++j) {
      const testing::TestInfo& one = *suite.GetTestInfo(j);
      Names& names = files.contains(fileName(one.file())) ? cases.chosen : cases.others;
      names.insert(std::string{suite.name()} + "." + one.name());
    }
  }
  return cases;
}

}  // namespace

void runChosenFilesOnly(int argc, const char* const* argv) {
  const std::optional<Names> files = chosenFiles(argc, argv);
  if (!files) return;
  const Cases cases = casesByFile(*files);
  if (cases.chosen.empty()) throw std::runtime_error{"no test stands in the chosen files"};
  std::string filter = GTEST_FLAG_GET(filter);
  filter += filter.find('-') == std::string::npos ? "-" : ":";
  for (const std::string& name : cases.others) {
    if (cases.chosen.contains(name)) throw std::runtime_error{"two files have a test " + name};
    filter += name + ":";
  }
  GTEST_FLAG_SET(filter, filter);
}

}  // namespace burin::test
