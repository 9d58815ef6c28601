#include "burin/compositor/schedule_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace burin::compositor {
namespace {

using testing::HasSubstr;

// The checker is what the tests of schedules rest on: every kind of fault must be found.
class ScheduleProblem : public testing::Test {
 protected:
  std::string found() const { return scheduleProblem(schedule_).value_or(""); }
  std::vector<Step>& steps(std::size_t i) { return schedule_.plans[i].steps; }
  Schedule schedule_ = makeSchedule({ScheduleKind::kBinarySwap}, 4, evenCuts(64, 4));
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
  EXPECT_THAT(found(), HasSubstr("takes front for back"));
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

TEST_F(ScheduleProblem, BlocksThatAreNoNeighbours) {
  // Distances 2, 1 instead of 1, 2: 0 and 2 meet before 1 has been combined.
  std::vector<std::vector<Step>> before;
  for (const Plan& plan : schedule_.plans) before.push_back(plan.steps);
  constexpr std::array<int, 4> kSwapped{0, 2, 1, 3};
  for (std::size_t i = 0; i < 4; ++i) {
    steps(i) = before[static_cast<std::size_t>(kSwapped[i])];
    for (Step& step : steps(i)) {
      step.peer = kSwapped[static_cast<std::size_t>(step.peer)];
      const bool isReceive = step.kind == Step::Kind::kReceive;
      step.peerIsInFront = isReceive && step.peer < static_cast<int>(i);
    }
  }
  EXPECT_THAT(found(), HasSubstr("no neighbours"));
}

TEST_F(ScheduleProblem, CombinedTwice) {
  schedule_ = makeSchedule({ScheduleKind::kDirectSend}, 4, evenCuts(64, 4));
  // 1 receives 2's part twice and 3's never; and 2 has sent it twice, from 3's share.
  steps(1)[5].peer = 2;
  EXPECT_THAT(found(), testing::AnyOf(HasSubstr("twice"), HasSubstr("waits for ever")));
  auto again = steps(2)[2];
  steps(2).insert(steps(2).begin(), again);
  EXPECT_NE(found(), "");
}

TEST_F(ScheduleProblem, RoundInAnyOrder) {
  schedule_ = makeSchedule({ScheduleKind::kDirectSend}, 5, evenCuts(64, 5));
  for (Plan& plan : schedule_.plans) std::reverse(plan.steps.begin() + 4, plan.steps.end());
  EXPECT_EQ(found(), "");
}

// Whatever one step is changed into, dropped or doubled, something is wrong: no step is needless.
// (Where a step stands among the others does matter only across rounds.)
TEST_F(ScheduleProblem, NoFaultInAnyStepGoesUnnoticed) {
  const std::vector<ScheduleOptions> all{{ScheduleKind::kBinarySwap},
                                         {ScheduleKind::kRadixK, {4}},
                                         {ScheduleKind::kDirectSend},
                                         {ScheduleKind::kSerialGather}};
  std::mt19937 random{7};
  const auto below = [&](std::size_t n) { return random() % n; };
  for (int i = 0; i < 4000; ++i) {
    const ScheduleOptions& options = all[below(all.size())];
    const int n = 2 + static_cast<int>(below(30));
    schedule_ = makeSchedule(options, n, evenCuts(1000, pieceCount(options, n)));
    auto& changed = steps(below(static_cast<std::size_t>(n)));
    if (changed.empty()) continue;
    const std::size_t at = below(changed.size());
    const auto kind = below(6);
    switch (kind) {
      case 0:
        changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      case 1:
        changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(at), changed[at]);
        break;
      case 2:
        changed[at].peer = (changed[at].peer + 1) % n;
        break;
      case 3:
        ++changed[at].region.begin;
        break;
      case 4:
        --changed[at].region.end;
        break;
      default:
        changed[at].kind =
            changed[at].kind == Step::Kind::kSend ? Step::Kind::kReceive : Step::Kind::kSend;
    }
    EXPECT_NE(found(), "") << n << " participants, kind " << static_cast<int>(options.kind)
                           << ", fault " << kind << " in step " << at;
  }
}

}  // namespace
}  // namespace burin::compositor
