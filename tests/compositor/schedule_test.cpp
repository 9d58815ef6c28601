#include "burin/compositor/schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "burin/compositor/schedule_check.hpp"
#include "burin/compositor/schedule_radices.hpp"

namespace burin::compositor {
namespace {

constexpr std::size_t kPositions = 4000;

LazySchedule evenSchedule(const ScheduleOptions& options, int participants,
                          std::size_t positions = kPositions) {
  return lazySchedule(options, participants,
                      evenCuts(positions, pieceCount(options, participants)));
}

Schedule wholeSchedule(const ScheduleOptions& options, int participants,
                       std::size_t positions = kPositions) {
  return makeSchedule(options, participants,
                      evenCuts(positions, pieceCount(options, participants)));
}

std::string problem(const LazySchedule& schedule) {
  return scheduleProblem(schedule).value_or("");
}

class Schedules : public testing::TestWithParam<ScheduleOptions> {};

TEST_P(Schedules, AreSoundForAnyCount) {  // and schedule_scale_test.cpp for larger ones
  for (int n = 1; n <= 70; ++n) {
    for (const std::size_t positions :
         {kPositions, std::size_t{1}, std::size_t{3}, std::size_t{0}}) {
      EXPECT_EQ(problem(evenSchedule(GetParam(), n, positions)), "") << n << ", " << positions;
    }
  }
}

TEST_P(Schedules, AreSoundWithAnyCuts) {
  for (const int n : {2, 3, 5, 8, 17, 29, 31}) {
    const int pieces = pieceCount(GetParam(), n);
    for (int empty = 0; empty <= pieces;
         ++empty) {  // only one piece is not empty, then ragged ones
      std::vector<std::size_t> cuts(static_cast<std::size_t>(pieces) + 1, 7);
      for (std::size_t i = static_cast<std::size_t>(empty) + 1; i < cuts.size(); ++i) cuts[i] = 9;
      EXPECT_EQ(problem(lazySchedule(GetParam(), n, cuts)), "") << n << ", " << empty;
      for (std::size_t i = 0; i < cuts.size(); ++i) cuts[i] = 10 + i / 3 * 5;
      EXPECT_EQ(problem(lazySchedule(GetParam(), n, cuts)), "") << n;
    }
  }
}

TEST_P(Schedules, OwnedPieceIsThatOfPieceOf) {
  for (int n = 1; n <= 70; ++n) {
    const int pieces = pieceCount(GetParam(), n);
    const auto cuts = evenCuts(kPositions, pieces);
    std::set<int> owned;
    for (int i = 0; i < n; ++i) {
      const Plan plan = makePlan(GetParam(), n, cuts, i);
      const int piece = pieceOf(GetParam(), n, i);
      if (piece < 0) {
        EXPECT_TRUE(plan.owned.empty());
        continue;
      }
      const auto at = static_cast<std::size_t>(piece);
      EXPECT_EQ(plan.owned, (Region{cuts[at], cuts[at + 1]})) << i << " of " << n;
      EXPECT_TRUE(owned.insert(piece).second);
    }
    EXPECT_EQ(owned.size(), static_cast<std::size_t>(pieces));
  }
}

// Whoever owns none is sent by its plan to its holder, possibly over others.
TEST_P(Schedules, HolderOwnsAPiece) {
  for (int n = 1; n <= 70; ++n) {
    for (int i = 0; i < n; ++i) {
      const int holder = holderOf(GetParam(), n, i);
      ASSERT_TRUE(holder >= 0 && holder < n);
      EXPECT_GE(pieceOf(GetParam(), n, holder), 0);
      if (pieceOf(GetParam(), n, i) >= 0) {
        EXPECT_EQ(holder, i);
      }
    }
  }
}

TEST_P(Schedules, LazyAndWholeAreTheSame) {
  for (const int n : {1, 6, 17, 31}) {
    const Schedule whole = wholeSchedule(GetParam(), n);
    const LazySchedule lazy = evenSchedule(GetParam(), n);
    EXPECT_EQ(lazy.all, whole.all);
    for (int i = 0; i < n; ++i) {
      EXPECT_EQ(lazy.plan(i), whole.plans[static_cast<std::size_t>(i)]);
    }
  }
}

// Nobody sends or receives more than a whole image, whatever the count; folding would make it
// nearly two. (Radices that somebody wished for may cut the rest unevenly: a tenth more.)
TEST_P(Schedules, NobodySendsMoreThanOneImage) {
  for (int n = 1; n <= 100; ++n) {
    for (const Plan& plan : wholeSchedule(GetParam(), n).plans) {
      std::size_t sent = 0, received = 0;
      for (const Step& step : plan.steps) {
        (step.kind == Step::Kind::kSend ? sent : received) += step.region.end - step.region.begin;
      }
      EXPECT_LE(sent, kPositions);
      // Rounding to whole positions: at most one in each round.
      if (GetParam().kind != ScheduleKind::kSerialGather && GetParam().radices.empty()) {
        EXPECT_LE(received, kPositions + 2 * static_cast<std::size_t>(n)) << n;
      }
    }
  }
}

TEST_P(Schedules, OneParticipantHasNothingToDo) {
  EXPECT_EQ(wholeSchedule(GetParam(), 1).plans, (std::vector<Plan>{{{}, {0, kPositions}}}));
}

std::string nameOf(const testing::TestParamInfo<ScheduleOptions>& info) {
  switch (info.param.kind) {
    case ScheduleKind::kBinarySwap:
      return "BinarySwap";
    case ScheduleKind::kDirectSend:
      return "DirectSend";
    case ScheduleKind::kSerialGather:
      return "SerialGather";
    case ScheduleKind::kRadixK:
      break;
  }
  std::string name = "RadixK";
  for (const int radix : info.param.radices) name += std::to_string(radix);
  return name;
}
INSTANTIATE_TEST_SUITE_P(, Schedules,
                         testing::Values(ScheduleOptions{ScheduleKind::kBinarySwap},
                                         ScheduleOptions{ScheduleKind::kRadixK},
                                         ScheduleOptions{ScheduleKind::kRadixK, {4}},
                                         ScheduleOptions{ScheduleKind::kRadixK, {3, 2, 5}},
                                         ScheduleOptions{ScheduleKind::kDirectSend},
                                         ScheduleOptions{ScheduleKind::kSerialGather}),
                         nameOf);

TEST(SerialGather, AnyCollector) {
  for (int n = 1; n <= 9; ++n) {
    for (int collector = 0; collector < n; ++collector) {
      const ScheduleOptions options{ScheduleKind::kSerialGather, {}, collector};
      EXPECT_EQ(problem(evenSchedule(options, n)), "");
      EXPECT_EQ(pieceOf(options, n, collector), 0);
    }
  }
}

TEST(BinarySwap, TwoRanksSwapHalves) {
  const Schedule s = wholeSchedule({ScheduleKind::kBinarySwap}, 2, 10);
  EXPECT_EQ(s.plans[0].steps, (std::vector<Step>{{Step::Kind::kSend, 1, {5, 10}, false},
                                                 {Step::Kind::kReceive, 1, {0, 5}, false}}));
  EXPECT_EQ(s.plans[1].steps, (std::vector<Step>{{Step::Kind::kSend, 0, {0, 5}, false},
                                                 {Step::Kind::kReceive, 0, {5, 10}, true}}));
  EXPECT_EQ(s.plans[0].owned, (Region{0, 5}));
  EXPECT_EQ(s.plans[1].owned, (Region{5, 10}));
}

TEST(BinarySwap, RoundsAreOfThePrimeFactors) {
  EXPECT_EQ(binarySwapRadices(1), (std::vector<int>{}));
  EXPECT_EQ(binarySwapRadices(8), (std::vector<int>{2, 2, 2}));
  EXPECT_EQ(binarySwapRadices(5), (std::vector<int>{5}));
  EXPECT_EQ(binarySwapRadices(60), (std::vector<int>{5, 3, 2, 2}));
  EXPECT_EQ(binarySwapRadices(17), (std::vector<int>{2, 2, 2, 2}));  // and one beside them
}

TEST(BinarySwap, TheRestIsSpreadOverAFew) {
  for (int n = 14; n <= 4096; ++n) {
    const int base = swapBase(n);
    ASSERT_TRUE(base <= n && n - base <= base) << n;
    if (base < n) {
      ASSERT_LE(base, 16 * (n - base)) << n;
    }
  }
}

// Ma et al. 1994: with n = 2^k ranks and A pixels each rank sends A(1 - 1/n) pixels in k messages.
TEST(BinarySwap, SendsWhatThePaperSays) {
  for (int k = 0; k <= 9; ++k) {
    const int n = 1 << k;
    const std::size_t pixels = 512 * 512;
    for (const Plan& plan : wholeSchedule({ScheduleKind::kBinarySwap}, n, pixels).plans) {
      std::size_t sent = 0;
      int messages = 0;
      for (const Step& step : plan.steps) {
        if (step.kind != Step::Kind::kSend) continue;
        sent += step.region.end - step.region.begin;
        ++messages;
      }
      EXPECT_EQ(sent, pixels - pixels / static_cast<std::size_t>(n));
      EXPECT_EQ(messages, k);
    }
  }
}

TEST(RadixK, FewRoundsOfAboutEight) {
  EXPECT_EQ(defaultRadices(1), (std::vector<int>{}));
  EXPECT_EQ(defaultRadices(8), (std::vector<int>{8}));
  EXPECT_EQ(defaultRadices(16), (std::vector<int>{4, 4}));
  EXPECT_EQ(defaultRadices(64), (std::vector<int>{8, 8}));
  for (int n = 14; n <= 4096; ++n) {
    for (const int radix : defaultRadices(n)) ASSERT_TRUE(radix >= 2 && radix <= 16) << n;
  }
}

TEST(RadixK, RadicesAreFittedToTheCount) {
  EXPECT_EQ(fittedRadices({4, 4}, 16), (std::vector<int>{4, 4}));
  EXPECT_EQ(fittedRadices({4, 4}, 15), (std::vector<int>{4, 3}));
  EXPECT_EQ(fittedRadices({4}, 64), (std::vector<int>{4, 16}));
  EXPECT_EQ(fittedRadices({4}, 3), (std::vector<int>{3}));
  EXPECT_EQ(fittedRadices({4}, 5), (std::vector<int>{4}));
  EXPECT_EQ(fittedRadices({4}, 1), (std::vector<int>{}));
  EXPECT_THROW(fittedRadices({1}, 4), std::logic_error);
}

TEST(RadixK, OneRadixOfAllIsDirectSend) {
  for (const int n : {2, 5, 12}) {
    EXPECT_EQ(wholeSchedule({ScheduleKind::kRadixK, {n}}, n).plans,
              wholeSchedule({ScheduleKind::kDirectSend}, n).plans);
  }
}

TEST(EvenCuts, DifferByOneAtMost) {
  for (const std::size_t positions : {0u, 1u, 7u, 100u}) {
    for (int pieces = 1; pieces <= 12; ++pieces) {
      const auto cuts = evenCuts(positions, pieces);
      EXPECT_EQ(cuts.front(), 0u);
      EXPECT_EQ(cuts.back(), positions);
      const std::size_t least = positions / static_cast<std::size_t>(pieces);
      for (std::size_t i = 1; i < cuts.size(); ++i) {
        EXPECT_GE(cuts[i], cuts[i - 1] + least);
        EXPECT_LE(cuts[i], cuts[i - 1] + least + 1);
      }
    }
  }
}

TEST(Schedule, RejectsWrongArguments) {
  const ScheduleOptions swap;
  EXPECT_THROW(makePlan(swap, 4, evenCuts(10, 3), 0), std::logic_error);
  EXPECT_THROW(makePlan(swap, 4, evenCuts(10, 4), 4), std::logic_error);
  EXPECT_THROW(pieceCount(swap, 0), std::logic_error);
  EXPECT_THROW(pieceCount({ScheduleKind::kSerialGather, {}, 3}, 3), std::logic_error);
}

}  // namespace
}  // namespace burin::compositor
