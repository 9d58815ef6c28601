#include "burin/common/communicator.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <chrono>
#include <thread>

#include "support/mpi_test.hpp"

namespace burin {
namespace {

using test::world;

int rankIndex() {
  return static_cast<int>(world().rank());
}

double cpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

TEST(Communicator, KnowsRankAndSizeOfItsParent) {
  int rank = -1;
  int size = -1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  EXPECT_EQ(rankIndex(), rank);
  EXPECT_EQ(world().size(), size);
  EXPECT_EQ(world().isRoot(), rank == 0);
}

TEST(Communicator, MovesWithoutLosingOrSharingItsHandle) {
  Communicator first{world().get()};
  const MPI_Comm handle = first.get();
  Communicator second{std::move(first)};
  EXPECT_EQ(second.get(), handle);
  EXPECT_EQ(first.get(), MPI_COMM_NULL);  // NOLINT(bugprone-use-after-move)
  first = std::move(second);
  EXPECT_EQ(first.get(), handle);
  EXPECT_EQ(first.rank(), world().rank());
  barrier(first);
}

TEST(Communicator, DuplicateDoesNotSeeTheOthersMessages) {
  const Communicator other{world().get()};
  const int self = rankIndex();
  int sent = 17;
  MPI_Request send = MPI_REQUEST_NULL;
  checkMpi(MPI_Isend(&sent, 1, MPI_INT, self, 3, world().get(), &send), "MPI_Isend");
  int arrived = 0;
  checkMpi(MPI_Iprobe(self, 3, other.get(), &arrived, MPI_STATUS_IGNORE), "MPI_Iprobe");
  EXPECT_EQ(arrived, 0);
  int received = 0;
  MPI_Request receive = MPI_REQUEST_NULL;
  checkMpi(MPI_Irecv(&received, 1, MPI_INT, self, 3, world().get(), &receive), "MPI_Irecv");
  std::array requests{send, receive};
  waitIdle(requests);
  EXPECT_EQ(received, 17);
  EXPECT_EQ(requests[0], MPI_REQUEST_NULL);
  EXPECT_EQ(requests[1], MPI_REQUEST_NULL);
}

TEST(CheckMpi, NamesCallAndReason) {
  EXPECT_NO_THROW(checkMpi(MPI_SUCCESS, "MPI_Send"));
  try {
    int value = 0;
    checkMpi(MPI_Send(&value, 1, MPI_INT, world().size(), 0, world().get()), "MPI_Send");
    FAIL() << "a rank outside the communicator was accepted";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::kRank);
    EXPECT_NE(std::string{e.what()}.find("MPI_Send: MPI_ERR_RANK"), std::string::npos) << e.what();
  }
}

TEST(WaitIdle, NamesWhatWasAwaitedWhenItFails) {
  const int self = rankIndex();
  const std::array<int, 2> sent{1, 2};
  MPI_Request send = MPI_REQUEST_NULL;
  checkMpi(MPI_Isend(sent.data(), 2, MPI_INT, self, 4, world().get(), &send), "MPI_Isend");
  int tooSmall = 0;
  MPI_Request receive = MPI_REQUEST_NULL;
  checkMpi(MPI_Irecv(&tooSmall, 1, MPI_INT, self, 4, world().get(), &receive), "MPI_Irecv");
  try {
    waitIdle(receive, "two numbers");
    ADD_FAILURE() << "a truncated message was accepted";
  } catch (const Error& e) {
    EXPECT_NE(std::string{e.what()}.find("waiting for two numbers: MPI_ERR_TRUNCATE"),
              std::string::npos)
        << e.what();
  }
  waitIdle(send);
}

TEST(WaitIdle, TellsSizeAndSourceOfTheMessage) {
  const int next = (rankIndex() + 1) % world().size();
  const int previous = (rankIndex() + world().size() - 1) % world().size();
  const std::vector<int> sent(static_cast<std::size_t>(rankIndex()) + 1, 5);
  MPI_Request send = MPI_REQUEST_NULL;
  checkMpi(MPI_Isend(sent.data(), mpiCount(sent.size()), MPI_INT, next, 5, world().get(), &send),
           "MPI_Isend");
  std::vector<int> received(static_cast<std::size_t>(world().size()));
  MPI_Request receive = MPI_REQUEST_NULL;
  checkMpi(MPI_Irecv(received.data(), mpiCount(received.size()), MPI_INT, MPI_ANY_SOURCE, 5,
                     world().get(), &receive),
           "MPI_Irecv");
  const MPI_Status status = waitIdle(receive);
  int count = 0;
  MPI_Get_count(&status, MPI_INT, &count);
  EXPECT_EQ(count, previous + 1);
  EXPECT_EQ(status.MPI_SOURCE, previous);
  waitIdle(send);
}

// 2 s of waiting may cost 0.1 s of processor time: 5 % of a core. Processor time, not wall time, so
// that a loaded machine cannot fail it.
TEST(WaitIdle, WaitingRankUsesNextToNoProcessorTime) {
  if (world().size() == 1) GTEST_SKIP() << "nobody to wait for";
  barrier(world());
  const double before = cpuSeconds();
  if (world().isRoot()) std::this_thread::sleep_for(std::chrono::seconds{2});
  barrier(world());
  EXPECT_LE(cpuSeconds() - before, 0.05 * 2.0);
}

TEST(WaitIdle, IsWatchedAndCanBeEnded) {
  std::vector<std::string> awaited;
  setWaitWatch([&](const char* what) {
    awaited.emplace_back(what);
    throw std::runtime_error{"nobody will come"};
  });
  EXPECT_THROW(waitUntil([] { return false; }, "someone"), std::runtime_error);
  EXPECT_EQ(awaited, std::vector<std::string>{"someone"});
  setWaitWatch({});
  int tests = 0;
  waitUntil([&] { return ++tests > 3; });
  EXPECT_EQ(awaited.size(), 1u);
}

TEST(MpiCount, RefusesWhatAnIntCannotHold) {
  EXPECT_EQ(mpiCount(0x7fffffffU), 0x7fffffff);
  EXPECT_THROW(mpiCount(0x80000000U), Error);
}

TEST(Collectives, BroadcastBytesAndTextFromEveryRank) {
  for (int root = 0; root < world().size(); ++root) {
    std::array<std::uint8_t, 3> bytes{};
    if (rankIndex() == root) bytes = {1, static_cast<std::uint8_t>(root), 3};
    broadcastBytes(world(), std::as_writable_bytes(std::span{bytes}), Rank{root});
    EXPECT_EQ(bytes, (std::array<std::uint8_t, 3>{1, static_cast<std::uint8_t>(root), 3}));

    const std::string longText(100'000U + static_cast<unsigned>(root), 'x');
    EXPECT_EQ(broadcastText(world(), rankIndex() == root ? longText : "not this one", Rank{root}),
              longText);
    EXPECT_EQ(broadcastText(world(), rankIndex() == root ? "" : "nor this", Rank{root}), "");
  }
}

TEST(Collectives, ReduceInPlace) {
  const auto n = static_cast<double>(world().size());
  std::array<double, 2> reals{1.5, static_cast<double>(rankIndex())};
  allReduce(world(), reals, MPI_SUM);
  EXPECT_DOUBLE_EQ(reals[0], 1.5 * n);
  EXPECT_DOUBLE_EQ(reals[1], n * (n - 1) / 2);

  std::array<std::int64_t, 2> integers{rankIndex(), std::int64_t{1} << 40};
  allReduce(world(), integers, MPI_MAX);
  EXPECT_EQ(integers[0], world().size() - 1);
  EXPECT_EQ(integers[1], std::int64_t{1} << 40);
}

TEST(Collectives, GatherInRankOrder) {
  struct Pair {
    std::int32_t rank;
    double square;
  };
  const double r = rankIndex();
  const auto all = allGather(world(), Pair{rankIndex(), r * r});
  ASSERT_EQ(all.size(), static_cast<std::size_t>(world().size()));
  for (int i = 0; i < world().size(); ++i) {
    EXPECT_EQ(all[static_cast<std::size_t>(i)].rank, i);
    EXPECT_EQ(all[static_cast<std::size_t>(i)].square, static_cast<double>(i) * i);
  }
}

TEST(Collectively, ReturnsWhenNobodyFails) {
  int runs = 0;
  collectively(world(), "counting", [&] { ++runs; });
  EXPECT_EQ(runs, 1);
}

TEST(Collectively, EveryRankThrowsTheSameWhicheverRankFails) {
  for (int culprit = 0; culprit < world().size(); ++culprit) {
    try {
      collectively(world(), "opening", [&] {
        if (rankIndex() == culprit) fail(ExitCode::kVolume, "brick {}: no such file", culprit);
      });
      ADD_FAILURE() << "rank " << culprit << " failed and nobody heard of it";
    } catch (const CollectiveError& e) {
      EXPECT_EQ(e.code(), ExitCode::kVolume);
      EXPECT_EQ(e.culprit(), Rank{culprit});
      EXPECT_EQ(e.what(), fmt::format("opening: rank {0}: brick {0}: no such file", culprit));
    }
    barrier(world());  // nobody was left behind
  }
}

TEST(Collectively, NamesTheLowestOfSeveralFailingRanks) {
  const int last = world().size() - 1;
  const int lowest = std::min(1, last);
  try {
    collectively(world(), "work", [&] {
      if (rankIndex() >= lowest) throw std::runtime_error{fmt::format("from {}", rankIndex())};
    });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const CollectiveError& e) {
    EXPECT_EQ(e.code(), ExitCode::kRank);
    EXPECT_EQ(e.culprit(), Rank{lowest});
    EXPECT_EQ(e.what(), fmt::format("work: rank {0}: from {0}", lowest));
  }
}

TEST(Collectively, CatchesWhatIsNoException) {
  EXPECT_THROW(collectively(world(), "work", [] { throw 7; }), CollectiveError);
}

}  // namespace
}  // namespace burin
