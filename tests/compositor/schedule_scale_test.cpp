// Schedules of many participants, up to 16 million messages, and what the cost model makes of them:
// too slow under sanitizers.
#include <gtest/gtest.h>

#include <string>

#include "burin/compositor/cost_model.hpp"
#include "burin/compositor/schedule.hpp"
#include "burin/compositor/schedule_check.hpp"

namespace burin::compositor {
namespace {

std::string problem(const ScheduleOptions& options, int participants,
                    std::size_t positions = 1 << 20) {
  const auto cuts = evenCuts(positions, pieceCount(options, participants));
  return scheduleProblem(lazySchedule(options, participants, cuts)).value_or("");
}

TEST(ScheduleScale, AllAreSoundForAnyCount) {  // from where schedule_test.cpp ends
  const ScheduleOptions all[] = {{ScheduleKind::kBinarySwap},  {ScheduleKind::kRadixK},
                                 {ScheduleKind::kRadixK, {4}}, {ScheduleKind::kRadixK, {3, 2, 5}},
                                 {ScheduleKind::kDirectSend},  {ScheduleKind::kSerialGather}};
  for (const ScheduleOptions& options : all)
    for (int n = 71; n <= 150; ++n)
      for (const std::size_t positions : {4000u, 1u, 3u, 0u})
        EXPECT_EQ(problem(options, n, positions), "") << n << ", " << positions;
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

TEST(ScheduleScale, TheCostModelAnswersForThousands) {
  constexpr double kPixels = 1 << 20;
  constexpr WireSize kBytes{1.0, 0.0};
  constexpr Machine kMachine{{1e-4, 1e-5, 0.0, 1e-8}, {2e-9, 0.0}, 0};
  const auto ofKind = [](ScheduleKind kind, int n) {
    const int pieces = pieceCount({kind}, n);
    return lazySchedule({kind}, n, evenCuts(static_cast<std::size_t>(pieces), pieces));
  };
  double before = 0.0;
  for (const int n : {1024, 65536}) {
    const LazySchedule swap = ofKind(ScheduleKind::kBinarySwap, n);
    const double seconds =
        predict(swap, activePixels(denseWorkload(n, swap.all, kPixels)), kBytes, kMachine)
            .compositeSeconds;
    EXPECT_GT(seconds, before);
    before = seconds;
    const LazySchedule direct = ofKind(ScheduleKind::kDirectSend, n);
    const auto pixels = activePixels(denseWorkload(n, direct.all, kPixels));
    EXPECT_GT(predictAlike(direct, pixels, kBytes, kMachine).compositeSeconds, seconds);
  }
}

}  // namespace
}  // namespace burin::compositor
