#include "covering_in_process.hpp"

#include <gtest/gtest.h>

#include "burin/compositor/in_process_executor.hpp"
#include "covering_frames.hpp"

namespace burin::compositor::test {

namespace {

/// Every rank's messages are those of the plan, and what one counts as sent others count as
/// received.
template <typename Pixel>
void expectConsistentTraffic(const FrameRow& row, const InProcessFrame<Pixel>& frame) {
  const FramePlan& plan = frame.plan;
  const bool isShared = row.options().isSharingMemory;
  std::int64_t messages = 0;
  for (int i = 0; i < static_cast<int>(plan.participants.size()); ++i) {
    messages += std::ranges::count(plan.planOf(i).steps, Step::Kind::kSend, &Step::kind);
  }
  for (int i = 0; i < static_cast<int>(plan.contributors.size()) && !isShared; ++i) {
    if (plan.contributors[static_cast<std::size_t>(i)] == row.root()) continue;
    messages += plan.owned(i).empty() ? 0 : 1;
    messages += plan.assignment.exclusive[static_cast<std::size_t>(i)].empty() ? 0 : 1;
  }
  Traffic sum;
  for (const Traffic& traffic : frame.traffic) {
    sum.messagesSent += traffic.messagesSent;
    sum.bytesSent += traffic.bytesSent;
    sum.bytesReceived += traffic.bytesReceived;
    sum.bytesToRoot += traffic.bytesToRoot;
    sum.bytesByReference += traffic.bytesByReference;
    EXPECT_GE(traffic.bytesPackedAway, 0);
  }
  EXPECT_EQ(sum.messagesSent, messages);
  // In shared memory, pixels for the root are put into its frame: nobody receives them.
  EXPECT_EQ(sum.bytesSent, sum.bytesReceived + (isShared ? sum.bytesToRoot : 0));
  EXPECT_LE(sum.bytesByReference, isShared ? sum.bytesSent : 0);
}

template <PixelAlgebra A>
void expectSerialCombination(const FrameRow& row) {
  std::vector<Subimage<typename A::Pixel>> images;
  for (int i = 0; i < row.ranks; ++i) images.push_back(drawnBy<A>(row, i));
  const auto order = row.order();
  const auto result = compositeInProcess<A>(row.options(), row.size, order, images);
  for (const Outcome& outcome : result.outcomes) EXPECT_FALSE(outcome.failed) << outcome.reason;
  expectConsistentTraffic(row, result);
  EXPECT_TRUE(isSerialCombination<A>(row, result.frame));
  const auto again = compositeInProcess<A>(row.options(), row.size, order, images);
  EXPECT_TRUE(areEqual(again.frame, result.frame)) << "two runs differ";
}

}  // namespace

void expectSerialCombination(const FrameRow& row) {
  withAlgebra(row.pixel, [&](auto algebra) { expectSerialCombination<decltype(algebra)>(row); });
}

}  // namespace burin::compositor::test
