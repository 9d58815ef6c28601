#include "burin/common/clock_offset.hpp"

#include <gtest/gtest.h>

#include "support/mpi_test.hpp"

namespace burin {
namespace {

// Processes of one host have one steady clock, so the true offset is 0.
TEST(ClockOffset, IsWithinItsAccuracy) {
  for (int i = 0; i < 3; ++i) {
    const ClockOffset offset = clockOffset(test::world());
    EXPECT_LE(std::chrono::abs(offset.ahead), offset.accuracy);
    if (test::world().isRoot()) {
      EXPECT_EQ(offset.accuracy.count(), 0);
    } else {
      EXPECT_GT(offset.accuracy.count(), 0);
    }
  }
}

}  // namespace
}  // namespace burin
