#include "burin/common/memory_check.hpp"

#include <gtest/gtest.h>

#include "burin/common/error.hpp"
#include "burin/common/memory_room.hpp"
#include "support/mpi_test.hpp"

namespace burin {
namespace {

using test::world;

TEST(CheckMemory, NamesTheRankThatNeedsTooMuch) {
  constexpr std::int64_t kTooMuch = std::int64_t{1} << 50;
  for (int rank = 0; rank < world().size(); ++rank) {
    const bool isMe = world().rank() == Rank{rank};
    try {
      checkMemory(world(), {isMe ? kTooMuch : 0, "a palace"});
      ADD_FAILURE() << "1 PiB was granted";
    } catch (const CollectiveError& error) {
      EXPECT_EQ(error.culprit(), Rank{rank});
      EXPECT_EQ(error.code(), ExitCode::kRank);
      const std::string text = error.what();
      EXPECT_NE(text.find(fmt::format("memory: rank {}: a palace needs 1024 TiB", rank)),
                std::string::npos)
          << text;
    }
  }
}

// Two thirds for each of several ranks: too much together, whatever others use meanwhile.
TEST(CheckMemory, AddsUpTheRanksOfAHost) {
  std::int64_t room = memoryRoom().host;
  allReduce(world(), std::span{&room, 1}, MPI_MIN);
  const MemoryNeed need{world().size() == 1 ? room / 3 : room / 3 * 2, "a share"};
  if (world().size() == 1) {
    EXPECT_NO_THROW(checkMemory(world(), need));
  } else {
    EXPECT_THROW(checkMemory(world(), need), CollectiveError);
  }
}

}  // namespace
}  // namespace burin
