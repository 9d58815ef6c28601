#include "burin/common/clock_offset.hpp"

#include <array>
#include <optional>

namespace burin {

namespace {

using Nanoseconds = std::chrono::nanoseconds;

constexpr int kQuestions = 16;
constexpr int kTag = 1;

std::int64_t now() {
  return Nanoseconds{std::chrono::steady_clock::now().time_since_epoch()}.count();
}

/// MPI's own receive, which is awake when the message comes, as a sleep would count as its travel.
template <std::size_t kCount>
std::array<std::int64_t, kCount> receive(const Communicator& comm, Rank from) {
  std::array<std::int64_t, kCount> numbers{};
  checkMpi(MPI_Recv(numbers.data(), kCount, MPI_INT64_T, static_cast<int>(from), kTag, comm.get(),
                    MPI_STATUS_IGNORE),
           "MPI_Recv");
  return numbers;
}

template <std::size_t kCount>
void send(const Communicator& comm, Rank to, const std::array<std::int64_t, kCount>& numbers) {
  checkMpi(MPI_Send(numbers.data(), kCount, MPI_INT64_T, static_cast<int>(to), kTag, comm.get()),
           "MPI_Send");
}

/// Rank 0's part: asks a rank, then tells it what came out.
void measure(const Communicator& comm, Rank rank) {
  std::optional<ClockOffset> best;
  for (int i = 0; i < kQuestions; ++i) {
    const std::int64_t asked = now();
    send<1>(comm, rank, {asked});
    const auto [theirs] = receive<1>(comm, rank);
    const std::int64_t half = (now() - asked + 1) / 2;
    if (!best || Nanoseconds{half} < best->accuracy)
      best = {Nanoseconds{theirs - (asked + half)}, Nanoseconds{half}};
  }
  send<2>(comm, rank, {best->ahead.count(), best->accuracy.count()});
}

/// The other ranks' part. Waits idly for the first question, as it may be others' turn before.
ClockOffset answer(const Communicator& comm) {
  std::int64_t question = 0;
  MPI_Request first = MPI_REQUEST_NULL;
  checkMpi(MPI_Irecv(&question, 1, MPI_INT64_T, 0, kTag, comm.get(), &first), "MPI_Irecv");
  waitIdle(first, "rank 0's question for the time");
  send<1>(comm, Rank{0}, {now()});
  for (int i = 1; i < kQuestions; ++i) {
    receive<1>(comm, Rank{0});
    send<1>(comm, Rank{0}, {now()});
  }
  const auto [ahead, accuracy] = receive<2>(comm, Rank{0});
  return {Nanoseconds{ahead}, Nanoseconds{accuracy}};
}

}  // namespace

ClockOffset clockOffset(const Communicator& comm) {
  if (!comm.isRoot()) return answer(comm);
  for (int rank = 1; rank < comm.size(); ++rank) measure(comm, Rank{rank});
  return {};
}

}  // namespace burin
