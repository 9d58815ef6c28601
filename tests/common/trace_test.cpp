#include "burin/common/trace.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>

#include "burin/common/statistics.hpp"

namespace burin {
namespace {

TEST(Trace, RecordsSpansInTheOrderOfTheirEnds) {
  { const TraceSpan before{"before"}; }
  TraceRecording recording;
  {
    const TraceSpan outer{"outer"};
    const TraceSpan inner{"inner", 7};
  }
  ASSERT_EQ(recording.events().size(), 2u);
  const TraceEvent& inner = recording.events()[0];
  const TraceEvent& outer = recording.events()[1];
  EXPECT_EQ(std::string{inner.name}, "inner");
  EXPECT_EQ(inner.number, 7);
  EXPECT_EQ(std::string{outer.name}, "outer");
  EXPECT_EQ(outer.number, -1);
  EXPECT_LE(outer.begin, inner.begin);
  EXPECT_LE(inner.begin, inner.end);
  EXPECT_LE(inner.end, outer.end);
}

TEST(Trace, OfAPhaseIsWhatTheStatisticsCount) {
  TraceRecording recording;
  PhaseTimes times;
  { const PhaseTimer timer{times, Phase::kDraw}; }
  { const PhaseTimer untraced{times[Phase::kGather]}; }
  ASSERT_EQ(recording.events().size(), 1u);
  const TraceEvent& event = recording.events()[0];
  EXPECT_EQ(std::string{event.name}, "draw");
  const std::chrono::duration<double, std::milli> traced = event.end - event.begin;
  EXPECT_EQ(traced.count(), times[Phase::kDraw]);
}

TEST(Trace, LeavesOtherThreadsAlone) {
  TraceRecording recording;
  std::thread{[] { const TraceSpan other{"other"}; }}.join();
  EXPECT_TRUE(recording.events().empty());
}

TEST(Trace, EndsWithItsRecording) {
  { const TraceRecording recording; }
  EXPECT_FALSE(isTracing());
  { const TraceSpan after{"after"}; }
}

}  // namespace
}  // namespace burin
