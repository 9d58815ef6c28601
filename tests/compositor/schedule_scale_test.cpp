// Schedules of many participants, up to 16 million messages: too slow under sanitizers.
#include <gtest/gtest.h>

#include <string>

#include "burin/compositor/schedule.hpp"
#include "burin/compositor/schedule_check.hpp"

namespace burin::compositor {
namespace {

std::string problem(const ScheduleOptions& options, int participants) {
  const auto cuts = evenCuts(1 << 20, pieceCount(options, participants));
  return scheduleProblem(lazySchedule(options, participants, cuts)).value_or("");
}

TEST(ScheduleScale, SwapsAreSoundForThousands) {
  // Every 37th count, which meets all residues of the small primes, and those around powers.
  for (const ScheduleKind kind : {ScheduleKind::kBinarySwap, ScheduleKind::kRadixK}) {
    for (int n = 150; n < 4096; n += 37) EXPECT_EQ(problem({kind}, n), "") << n;
    for (const int n : {255, 256, 257, 509, 1024, 3125, 4095, 4096}) {
      EXPECT_EQ(problem({kind}, n), "") << n;
    }
  }
}

TEST(ScheduleScale, SerialGatherIsSoundForThousands) {
  for (const int n : {509, 4096}) {
    EXPECT_EQ(problem({ScheduleKind::kSerialGather, {}, n / 2}, n), "") << n;
  }
}

TEST(ScheduleScale, LargeRoundsAreSound) {
  for (const int n : {257, 1000, 4096}) {
    EXPECT_EQ(problem({ScheduleKind::kRadixK, {4}}, n), "") << n;
    EXPECT_EQ(problem({ScheduleKind::kDirectSend}, n), "") << n;
  }
}

}  // namespace
}  // namespace burin::compositor
