// Run by CTest on three ranks: only the last one fails, and the run must end with that failure.

#include <gtest/gtest.h>

#include "support/mpi_test.hpp"

TEST(MpiMain, FailsIfTheLastRankFails) {
  const burin::Communicator& world = burin::test::world();
  EXPECT_LT(static_cast<int>(world.rank()), world.size() - 1);
}
