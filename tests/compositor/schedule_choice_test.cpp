#include "burin/compositor/schedule_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace burin::compositor {
namespace {

constexpr std::size_t kFrame = 1024 * 1024;

// All that may be chosen, followed participant by participant, not just one of them.
TEST(ScheduleChoice, IsNearTheBestOfAll) {
  for (const LinkClass link : {LinkClass::kFast, LinkClass::kSlow}) {
    for (const int n : {2, 3, 5, 8, 13, 16, 24, 31, 64}) {
      for (const std::size_t total : {kFrame / 1000, kFrame / 10, kFrame * 2}) {
        const double complexity =
            std::clamp(static_cast<double>(total) / kFrame, std::cbrt(n), static_cast<double>(n));
        const auto seconds = [&](const ScheduleOptions& options) {
          const LazySchedule s =
              lazySchedule(options, n, evenCuts(1 << 20, pieceCount(options, n)));
          const Workload work{n, s.all, static_cast<double>(total) / n, complexity};
          return predict(s, activePixels(work), {}, assumedMachine(link)).seconds();
        };
        double best = INFINITY;
        for (const ScheduleKind kind : {ScheduleKind::kBinarySwap, ScheduleKind::kRadixK,
                                        ScheduleKind::kDirectSend, ScheduleKind::kSerialGather}) {
          best = std::min(best, seconds({kind}));
        }
        EXPECT_LE(seconds(chooseSchedule(n, total, kFrame, link, 16)), 1.05 * best)
            << "link " << static_cast<int>(link) << ", n " << n << ", total " << total;
      }
    }
  }
}

TEST(ScheduleChoice, OneRankAndNoPixelsAreNothingSpecial) {
  EXPECT_EQ(chooseSchedule(1, kFrame, kFrame, LinkClass::kFast, 16), ScheduleOptions{});
  for (const int n : {1, 2, 7, 100}) {
    for (const std::size_t frame : {std::size_t{0}, std::size_t{1}}) {
      EXPECT_GE(pieceCount(chooseSchedule(n, 0, frame, LinkClass::kSlow, 16), n), 1);
    }
  }
}

// One rank that combines all alone is worth it for a few pixels only.
TEST(ScheduleChoice, ManyPixelsAreSharedFewAreNot) {
  for (const LinkClass link : {LinkClass::kFast, LinkClass::kSlow}) {
    for (const int n : {8, 16, 64}) {
      const auto many = static_cast<std::size_t>(n) * kFrame;
      EXPECT_NE(chooseSchedule(n, many, kFrame, link, 16).kind, ScheduleKind::kSerialGather);
    }
    EXPECT_EQ(chooseSchedule(4, 4, kFrame, link, 16).kind, ScheduleKind::kSerialGather);
  }
}

TEST(ScheduleChoice, RanksOfOneHostReadEachOthersPixelsAtOnce) {
  for (const int n : {2, 5, 64}) {
    for (const std::size_t total : {std::size_t{4}, std::size_t{50} * kFrame}) {
      EXPECT_EQ(chooseSchedule(n, total, kFrame, LinkClass::kSharedMemory, 16).kind,
                ScheduleKind::kDirectSend);
    }
  }
}

// The larger the frame the less rounds cost, and bytes are fewest when nothing is sent twice.
TEST(ScheduleChoice, DirectSendDoesNotScaleToManyRanks) {
  for (const LinkClass link : {LinkClass::kSharedMemory, LinkClass::kFast, LinkClass::kSlow}) {
    EXPECT_NE(chooseSchedule(65536, 4 * kFrame, kFrame, link, 16).kind, ScheduleKind::kDirectSend);
  }
}

TEST(ScheduleChoice, SameArgumentsSameChoice) {
  for (int n = 1; n < 40; ++n) {
    EXPECT_EQ(chooseSchedule(n, kFrame, kFrame, LinkClass::kFast, 16),
              chooseSchedule(n, kFrame, kFrame, LinkClass::kFast, 16));
  }
}

}  // namespace
}  // namespace burin::compositor
