#include "burin/common/communicator.hpp"

#include <sched.h>
#include <sys/prctl.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <thread>

namespace burin {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::nanoseconds kSpin = std::chrono::microseconds{20};
constexpr std::chrono::nanoseconds kShortestSleep = std::chrono::microseconds{50};
constexpr std::chrono::nanoseconds kLongestSleep = std::chrono::milliseconds{2};
/// As long as this, sleeps stay short: a large message that MPI copies piece by piece moves by some
/// 100 KB per test, so longer sleeps would throttle it. Costs at most a few ms of processor time.
constexpr std::chrono::nanoseconds kAlertTime = std::chrono::milliseconds{50};
/// Then a sleep is this fraction of the time waited, so that a wait ends at most that much late.
constexpr int kBackOffFraction = 16;
constexpr std::chrono::nanoseconds kWatchInterval = std::chrono::milliseconds{100};

std::function<void(const char*)> waitWatch;

std::chrono::nanoseconds sleepAfter(std::chrono::nanoseconds waited) {
  return std::clamp((waited - kAlertTime) / kBackOffFraction, kShortestSleep, kLongestSleep);
}

/// Calls `isDone`, which lets MPI progress, until it returns true.
template <typename IsDone>
void pollIdly(const char* what, IsDone&& isDone) {
  const auto start = Clock::now();
  std::chrono::nanoseconds nextWatch = kWatchInterval;
  while (!isDone()) {
    const std::chrono::nanoseconds waited = Clock::now() - start;
    if (waited >= nextWatch) {
      watchWait(what);
      nextWatch = waited + kWatchInterval;
    }
    if (waited < kSpin) {
      sched_yield();  // the rank waited for may want this very core
    } else {
      std::this_thread::sleep_for(sleepAfter(waited));
    }
  }
}

std::string mpiErrorText(int code) {
  char text[MPI_MAX_ERROR_STRING] = {};
  int length = 0;
  if (MPI_Error_string(code, text, &length) != MPI_SUCCESS) return fmt::format("error {}", code);
  return {text, static_cast<std::size_t>(length)};
}

void checkWait(int code, const char* what) {
  if (code != MPI_SUCCESS) {
    fail(ExitCode::kRank, "waiting for {}: {}", what, mpiErrorText(code));
  }
}

int isFinalized() {
  int finalized = 0;
  MPI_Finalized(&finalized);
  return finalized;
}

}  // namespace

MpiRuntime::MpiRuntime(int* argc, char*** argv) {
  int provided = MPI_THREAD_SINGLE;
  checkMpi(MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
  if (provided < MPI_THREAD_FUNNELED) {
    fail(ExitCode::kRank, "MPI_Init_thread: MPI_THREAD_FUNNELED expected, level {} given",
         provided);
  }
  // By default the kernel may lengthen each sleep by 50 us, which doubles waitIdle's shortest.
  prctl(PR_SET_TIMERSLACK, 1UL);
}

MpiRuntime::~MpiRuntime() {
  if (isFinalized() == 0) MPI_Finalize();
}

Communicator::Communicator(MPI_Comm parent) {
  checkMpi(MPI_Comm_dup(parent, &comm_), "MPI_Comm_dup");
  checkMpi(MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  int rank = 0;
  checkMpi(MPI_Comm_rank(comm_, &rank), "MPI_Comm_rank");
  checkMpi(MPI_Comm_size(comm_, &size_), "MPI_Comm_size");
  rank_ = Rank{rank};
}

Communicator::Communicator(Communicator&& other) noexcept
    : comm_{std::exchange(other.comm_, MPI_COMM_NULL)}, rank_{other.rank_}, size_{other.size_} {}

Communicator& Communicator::operator=(Communicator&& other) noexcept {
  std::swap(comm_, other.comm_);
  std::swap(rank_, other.rank_);
  std::swap(size_, other.size_);
  return *this;
}

Communicator::~Communicator() {
  if (comm_ != MPI_COMM_NULL && isFinalized() == 0) MPI_Comm_free(&comm_);
}

void checkMpi(int code, const char* call) {
  if (code != MPI_SUCCESS) fail(ExitCode::kRank, "{}: {}", call, mpiErrorText(code));
}

MPI_Status waitIdle(MPI_Request& request, const char* what) {
  MPI_Status status{};
  pollIdly(what, [&] {
    int isDone = 0;
    checkWait(MPI_Test(&request, &isDone, &status), what);
    return isDone != 0;
  });
  return status;
}

void waitIdle(std::span<MPI_Request> requests, const char* what) {
  const int count = mpiCount(requests.size());
  pollIdly(what, [&] {
    int isDone = 0;
    checkWait(MPI_Testall(count, requests.data(), &isDone, MPI_STATUSES_IGNORE), what);
    return isDone != 0;
  });
}

void waitUntil(const std::function<bool()>& isDone, const char* what) {
  pollIdly(what, isDone);
}

void setWaitWatch(std::function<void(const char*)> watch) {
  waitWatch = std::move(watch);
}

void watchWait(const char* what) {
  if (waitWatch) waitWatch(what);
}

int mpiCount(std::size_t count) {
  constexpr auto kLargest = std::numeric_limits<int>::max();
  if (count > static_cast<std::size_t>(kLargest)) {
    fail(ExitCode::kRank, "MPI count: at most {} expected, {} given", kLargest, count);
  }
  return static_cast<int>(count);
}

void barrier(const Communicator& comm) {
  MPI_Request request = MPI_REQUEST_NULL;
  checkMpi(MPI_Ibarrier(comm.get(), &request), "MPI_Ibarrier");
  waitIdle(request, "a barrier");
}

void broadcastBytes(const Communicator& comm, std::span<std::byte> bytes, Rank root) {
  constexpr std::size_t kChunk = std::size_t{1} << 30;  // MPI counts in int
  while (!bytes.empty()) {
    const auto chunk = bytes.first(std::min(kChunk, bytes.size()));
    MPI_Request request = MPI_REQUEST_NULL;
    checkMpi(MPI_Ibcast(chunk.data(), mpiCount(chunk.size()), MPI_BYTE, static_cast<int>(root),
                        comm.get(), &request),
             "MPI_Ibcast");
    waitIdle(request, "a broadcast");
    bytes = bytes.subspan(chunk.size());
  }
}

std::string broadcastText(const Communicator& comm, std::string text, Rank root) {
  std::uint64_t length = text.size();
  broadcastBytes(comm, std::as_writable_bytes(std::span{&length, 1}), root);
  text.resize(length);
  broadcastBytes(comm, std::as_writable_bytes(std::span{text}), root);
  return text;
}

namespace {

void allReduceInPlace(const Communicator& comm, void* values, std::size_t count, MPI_Datatype type,
                      MPI_Op op) {
  MPI_Request request = MPI_REQUEST_NULL;
  checkMpi(MPI_Iallreduce(MPI_IN_PLACE, values, mpiCount(count), type, op, comm.get(), &request),
           "MPI_Iallreduce");
  waitIdle(request, "a reduction");
}

}  // namespace

void allReduce(const Communicator& comm, std::span<double> values, MPI_Op op) {
  allReduceInPlace(comm, values.data(), values.size(), MPI_DOUBLE, op);
}

void allReduce(const Communicator& comm, std::span<std::int64_t> values, MPI_Op op) {
  allReduceInPlace(comm, values.data(), values.size(), MPI_INT64_T, op);
}

std::vector<std::byte> allGatherBytes(const Communicator& comm, std::span<const std::byte> mine) {
  std::vector<std::byte> all(mine.size() * static_cast<std::size_t>(comm.size()));
  const int count = mpiCount(mine.size());
  MPI_Request request = MPI_REQUEST_NULL;
  checkMpi(MPI_Iallgather(mine.data(), count, MPI_BYTE, all.data(), count, MPI_BYTE, comm.get(),
                          &request),
           "MPI_Iallgather");
  waitIdle(request, "an all-gather");
  return all;
}

CollectiveError::CollectiveError(ExitCode code, std::string_view what, Rank culprit,
                                 const std::string& reason)
    : Error{code, fmt::format("{}: rank {}: {}", what, static_cast<int>(culprit), reason)},
      culprit_{culprit} {}

void agree(const Communicator& comm, std::string_view what, Outcome mine) {
  struct {
    int ok;
    int rank;
  } worst{mine.failed ? 0 : 1, static_cast<int>(comm.rank())};
  allReduceInPlace(comm, &worst, 1, MPI_2INT, MPI_MINLOC);
  if (worst.ok == 1) return;
  const Rank culprit{worst.rank};
  auto code = static_cast<std::int32_t>(mine.code);
  broadcastBytes(comm, std::as_writable_bytes(std::span{&code, 1}), culprit);
  const std::string reason = broadcastText(comm, std::move(mine.reason), culprit);
  throw CollectiveError{ExitCode{code}, what, culprit, reason};
}

}  // namespace burin
