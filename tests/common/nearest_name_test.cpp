#include "burin/common/nearest_name.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace burin {
namespace {

TEST(EditDistance, KnownDistances) {
  EXPECT_EQ(editDistance("", ""), 0u);
  EXPECT_EQ(editDistance("", "abc"), 3u);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(editDistance("saturday", "sunday"), 3u);
  EXPECT_EQ(editDistance("strengh", "strength"), 1u);
}

TEST(EditDistance, IsSymmetric) {
  const std::vector<std::string_view> words{"tone", "edges", "threshold", "strength", "", "t"};
  for (const auto a : words) {
    for (const auto b : words) EXPECT_EQ(editDistance(a, b), editDistance(b, a));
  }
}

TEST(NameSuggestion, NearestOrAll) {
  const std::vector<std::string_view> known{"strength", "threshold", "power"};
  EXPECT_EQ(nameSuggestion("strengh", known), "did you mean 'strength'?");
  EXPECT_EQ(nameSuggestion("treshhold", known), "did you mean 'threshold'?");
  EXPECT_EQ(nameSuggestion("zoom", known), "expected one of 'strength', 'threshold', 'power'");
  EXPECT_EQ(nameSuggestion("zoom", {}), "");
}

TEST(NameSuggestion, ShortNamesAreNotSuggestedForEverything) {
  const std::vector<std::string_view> known{"y", "z"};
  EXPECT_EQ(nameSuggestion("x", known), "expected one of 'y', 'z'");
}

}  // namespace
}  // namespace burin
