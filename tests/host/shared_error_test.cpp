#include "burin/host/shared_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/mpi_test.hpp"

namespace burin::host {
namespace {

using test::world;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(SharedError, NobodyFails) {
  int calls = 0;
  EXPECT_NO_THROW(together(world(), "x", [&] { ++calls; }));
  EXPECT_NO_THROW(onRoot(world(), [&] { ++calls; }));
  EXPECT_EQ(calls, world().isRoot() ? 2 : 1);
}

TEST(SharedError, SameWordsOnAllRanksNameNone) {
  try {
    together(world(), "opening", [] { fail(ExitCode::kVolume, "a.nrrd: no such file"); });
    FAIL() << "expected an error";
  } catch (const SharedError& error) {
    EXPECT_EQ(error.code(), ExitCode::kVolume);
    EXPECT_STREQ(error.what(), "a.nrrd: no such file");
  }
}

TEST(SharedError, OneRankAloneIsNamedOnAll) {
  if (world().size() == 1) GTEST_SKIP() << "one rank is all ranks";
  for (int culprit = 0; culprit < world().size(); ++culprit) {
    try {
      together(world(), "opening", [&] {
        if (world().rank() == Rank{culprit}) fail(ExitCode::kVolume, "not on this disk");
      });
      FAIL() << "expected an error";
    } catch (const CollectiveError& error) {
      EXPECT_EQ(error.code(), ExitCode::kVolume);
      EXPECT_EQ(error.culprit(), Rank{culprit});
      EXPECT_THAT(error.what(), HasSubstr("not on this disk"));
    }
  }
}

TEST(SharedError, DifferentWordsNameTheLowestRank) {
  if (world().size() == 1) GTEST_SKIP() << "one rank has one set of words";
  EXPECT_THROW(
      together(world(), "x",
               [&] { fail(ExitCode::kRank, "rank {}", static_cast<int>(world().rank())); }),
      CollectiveError);
}

TEST(SharedError, RootsFailureIsEverybodys) {
  try {
    onRoot(world(), [] { fail(ExitCode::kRank, "disk full"); });
    FAIL() << "expected an error";
  } catch (const SharedError& error) {
    EXPECT_EQ(error.code(), ExitCode::kRank);
    EXPECT_STREQ(error.what(), "disk full");
  }
}

}  // namespace
}  // namespace burin::host
