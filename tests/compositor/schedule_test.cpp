#include "burin/compositor/schedule.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>

#include "burin/compositor/schedule_check.hpp"

namespace burin::compositor {
namespace {

using testing::HasSubstr;

constexpr Region kFrame{0, 509 * 503};

class Schedules : public testing::TestWithParam<ScheduleKind> {};

TEST_P(Schedules, AreSoundForAnyCount) {
  for (int n = 1; n <= 64; ++n) {
    for (const Region& all : {kFrame, Region{5, 6}, Region{0, 3}, Region{0, 100}, Region{}}) {
      const auto problem = scheduleProblem(makeSchedule(GetParam(), n, all));
      EXPECT_FALSE(problem.has_value()) << n << " participants: " << *problem;
    }
  }
}

TEST_P(Schedules, AreSoundForManyParticipants) {
  for (const int n : {100, 128, 500}) {
    const auto problem = scheduleProblem(makeSchedule(GetParam(), n, kFrame));
    EXPECT_FALSE(problem.has_value()) << n << " participants: " << *problem;
  }
}

TEST_P(Schedules, OwnedRegionIsThatOfThePlan) {
  for (const int n : {1, 2, 3, 7, 8, 13}) {
    const Schedule schedule = makeSchedule(GetParam(), n, kFrame);
    for (int i = 0; i < n; ++i) {
      EXPECT_EQ(ownedRegion(GetParam(), n, kFrame, i),
                schedule.plans[static_cast<std::size_t>(i)].owned);
    }
  }
}

TEST_P(Schedules, OneParticipantHasNothingToDo) {
  EXPECT_EQ(makePlan(GetParam(), 1, kFrame, 0), (Plan{{}, kFrame}));
}

std::string nameOf(const testing::TestParamInfo<ScheduleKind>& kind) {
  return kind.param == ScheduleKind::kBinarySwap ? "BinarySwap" : "DirectSend";
}
INSTANTIATE_TEST_SUITE_P(, Schedules,
                         testing::Values(ScheduleKind::kBinarySwap, ScheduleKind::kDirectSend),
                         nameOf);

TEST(BinarySwap, TwoRanksSwapHalves) {
  const Schedule s = makeSchedule(ScheduleKind::kBinarySwap, 2, {0, 10});
  EXPECT_EQ(s.plans[0].steps, (std::vector<Step>{{Step::Kind::kSend, 1, {5, 10}, false},
                                                 {Step::Kind::kReceive, 1, {0, 5}, false}}));
  EXPECT_EQ(s.plans[1].steps, (std::vector<Step>{{Step::Kind::kSend, 0, {0, 5}, false},
                                                 {Step::Kind::kReceive, 0, {5, 10}, true}}));
  EXPECT_EQ(s.plans[0].owned, (Region{0, 5}));
  EXPECT_EQ(s.plans[1].owned, (Region{5, 10}));
}

TEST(BinarySwap, ThreeRanksFoldTheSecondIntoItsFrontNeighbour) {
  const Schedule s = makeSchedule(ScheduleKind::kBinarySwap, 3, {0, 10});
  EXPECT_EQ(s.plans[1].steps, (std::vector<Step>{{Step::Kind::kSend, 0, {0, 10}, false}}));
  EXPECT_TRUE(s.plans[1].owned.empty());
  EXPECT_EQ(s.plans[0].steps.front(), (Step{Step::Kind::kReceive, 1, {0, 10}, false}));
}

// Ma et al. 1994: with n = 2^k ranks and A pixels each rank sends A(1 - 1/n) pixels in k messages.
TEST(BinarySwap, SendsWhatThePaperSays) {
  for (const int n : {1, 2, 4, 8, 64, 512}) {
    const Region all{0, 512 * 512};
    const Schedule schedule = makeSchedule(ScheduleKind::kBinarySwap, n, all);
    for (const Plan& plan : schedule.plans) {
      std::size_t pixels = 0;
      int messages = 0;
      for (const Step& step : plan.steps) {
        if (step.kind != Step::Kind::kSend) continue;
        pixels += step.region.pixels();
        ++messages;
      }
      EXPECT_EQ(pixels, all.pixels() - all.pixels() / static_cast<std::size_t>(n));
      EXPECT_EQ(messages, std::countr_zero(static_cast<unsigned>(n)));
      EXPECT_EQ(plan.owned.pixels(), all.pixels() / static_cast<std::size_t>(n));
    }
  }
}

// The checker is what the tests above rest on: every kind of fault must be found.
class ScheduleProblem : public testing::Test {
 protected:
  std::string found() const { return scheduleProblem(schedule_).value_or(""); }
  std::vector<Step>& steps(std::size_t i) { return schedule_.plans[i].steps; }
  Schedule schedule_ = makeSchedule(ScheduleKind::kBinarySwap, 4, {0, 64});
};

TEST_F(ScheduleProblem, NoneAtFirst) {
  EXPECT_EQ(found(), "");
}

TEST_F(ScheduleProblem, MissingReceive) {
  steps(2).pop_back();
  EXPECT_THAT(found(), HasSubstr("sends to 2 what is never received"));
}

TEST_F(ScheduleProblem, MissingSend) {
  steps(0).erase(steps(0).begin() + 2);  // of the last round, whose receive then drops pixels
  EXPECT_THAT(found(), HasSubstr("participant 0, step 2: drops pixels"));
  steps(0).pop_back();
  EXPECT_THAT(found(), HasSubstr("waits for ever"));
}

TEST_F(ScheduleProblem, CyclicWait) {
  std::swap(steps(0)[0], steps(0)[1]);
  std::swap(steps(1)[0], steps(1)[1]);
  EXPECT_THAT(found(), HasSubstr("waits for ever"));
}

TEST_F(ScheduleProblem, FrontTakenForBack) {
  for (auto& step : steps(3)) step.peerIsInFront = !step.peerIsInFront;
  EXPECT_THAT(found(), HasSubstr("no neighbours"));
}

TEST_F(ScheduleProblem, WrongNeighboursFirst) {
  for (Plan& plan : schedule_.plans) {  // distances 2, 1 instead of 1, 2
    for (Step& step : plan.steps) step.peer = step.peer == 0 ? 0 : step.peer ^ 3;
  }
  EXPECT_NE(found(), "");
}

TEST_F(ScheduleProblem, AnotherRegionThanWasSent) {
  --steps(0)[0].region.end;
  EXPECT_THAT(found(), HasSubstr("a region it did not expect"));
}

TEST_F(ScheduleProblem, SentTwice) {
  steps(0).insert(steps(0).begin(), steps(0)[0]);
  EXPECT_THAT(found(), HasSubstr("sends pixels it does not hold"));
}

TEST_F(ScheduleProblem, DroppedPixels) {
  steps(0)[0].region.begin += 8;
  steps(1)[1].region.begin += 8;
  EXPECT_THAT(found(), HasSubstr("drops pixels"));
}

TEST_F(ScheduleProblem, IncompleteInTheEnd) {
  for (std::size_t i = 0; i < 4; ++i) steps(i).resize(2);
  EXPECT_THAT(found(), HasSubstr("participant 0"));
}

TEST_F(ScheduleProblem, OwnedByTwo) {
  schedule_.plans[1].owned = schedule_.plans[0].owned;
  EXPECT_NE(found(), "");
}

TEST_F(ScheduleProblem, OwnedByNone) {
  schedule_.plans[1].owned = {};
  EXPECT_THAT(found(), HasSubstr("pixels it does not own"));
}

TEST_F(ScheduleProblem, NoSuchPeerOrEmptyRegion) {
  steps(0)[0].peer = 4;
  EXPECT_THAT(found(), HasSubstr("no such peer"));
  steps(0)[0].peer = 0;
  EXPECT_THAT(found(), HasSubstr("no such peer"));
  steps(0)[0] = {Step::Kind::kSend, 1, {3, 3}, false};
  EXPECT_THAT(found(), HasSubstr("an empty region"));
}

}  // namespace
}  // namespace burin::compositor
