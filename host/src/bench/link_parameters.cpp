#include "bench/link_parameters.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace burin::host::bench {

namespace {

constexpr int kTag = 7;
constexpr int kFlood = 64;
constexpr std::size_t kSmall = 8;
/// Both beyond what MPI sends without being asked, so that they differ in nothing but bytes.
constexpr std::size_t kLong = std::size_t{128} << 10;
constexpr std::size_t kLonger = std::size_t{512} << 10;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double medianOf(const std::function<double()>& measure) {
  constexpr int kRepeats = 5;
  std::array<double, kRepeats> values{};
  std::ranges::generate(values, measure);
  std::ranges::sort(values);
  return values[kRepeats / 2];
}

/// One end of the link; both ends call the same functions.
class End {
 public:
  End(const Communicator& comm, int peer, bool isFirst)
      : comm_{comm}, peer_{peer}, isFirst_{isFirst}, buffer_(kLonger) {}

  /// Of the first end: `count` messages there, an answer back.
  double roundTrip(std::size_t bytes, int count) {
    const double start = seconds();
    if (isFirst_) {
      send(bytes, count);
      receive(kSmall, 1);
    } else {
      receive(bytes, count);
      send(kSmall, 1);
    }
    return seconds() - start;
  }

  /// Of the first end: until `count` sends have been handed to MPI, each.
  double perSend(int count) {
    double duration = 0.0;
    if (isFirst_) {
      std::vector<MPI_Request> requests(static_cast<std::size_t>(count));
      const double start = seconds();
      for (MPI_Request& request : requests) request = isend(kSmall);
      duration = seconds() - start;
      waitIdle(requests);
      receive(kSmall, 1);
    } else {
      receive(kSmall, count);
      send(kSmall, 1);
    }
    return duration / count;
  }

 private:
  MPI_Request isend(std::size_t bytes) {
    MPI_Request request = MPI_REQUEST_NULL;
    checkMpi(
        MPI_Isend(buffer_.data(), mpiCount(bytes), MPI_BYTE, peer_, kTag, comm_.get(), &request),
        "MPI_Isend");
    return request;
  }
  void send(std::size_t bytes, int count) {
    std::vector<MPI_Request> requests;
    for (int i = 0; i < count; ++i) requests.push_back(isend(bytes));
    waitIdle(requests);
  }
  void receive(std::size_t bytes, int count) {
    for (int i = 0; i < count; ++i) {
      MPI_Request request = MPI_REQUEST_NULL;
      checkMpi(
          MPI_Irecv(buffer_.data(), mpiCount(bytes), MPI_BYTE, peer_, kTag, comm_.get(), &request),
          "MPI_Irecv");
      waitIdle(request);
    }
  }

  const Communicator& comm_;
  int peer_;
  bool isFirst_;
  std::vector<std::byte> buffer_;
};

compositor::LogGP measureBetween(End& end) {
  end.roundTrip(kLonger, 1);  // the connection and its windows
  compositor::LogGP link;
  const double there = 0.5 * medianOf([&] { return end.roundTrip(kSmall, 1); });
  link.overhead = medianOf([&] { return end.perSend(kFlood); });
  link.latency = std::max(0.0, there - 2.0 * link.overhead);
  link.gap = std::max(
      link.overhead,
      (medianOf([&] { return end.roundTrip(kSmall, kFlood); }) - 2.0 * there) / (kFlood - 1));
  const double longer = medianOf([&] { return end.roundTrip(kLonger, 1); });
  const double shorter = medianOf([&] { return end.roundTrip(kLong, 1); });
  link.gapPerByte = std::max(0.0, longer - shorter) / static_cast<double>(kLonger - kLong);
  return link;
}

}  // namespace

compositor::LogGP measureLinkParameters(const Communicator& comm) {
  barrier(comm);
  std::array<double, 4> values{};
  const int last = comm.size() - 1;
  if (comm.isRoot() || static_cast<int>(comm.rank()) == last) {
    End end{comm, comm.isRoot() ? last : 0, comm.isRoot()};
    const compositor::LogGP link = measureBetween(end);
    if (comm.isRoot()) values = {link.latency, link.overhead, link.gap, link.gapPerByte};
  }
  broadcastBytes(comm, std::as_writable_bytes(std::span{values}), Rank{0});
  return {values[0], values[1], values[2], values[3]};
}

int sharedCores(const Communicator& comm) {
  std::array<char, 40> boot{};
  std::ifstream{"/proc/sys/kernel/random/boot_id"}.read(boot.data(), boot.size() - 1);
  const auto all = allGather(comm, boot);
  const bool isOneMachine =
      boot.front() != '\0' && std::ranges::all_of(all, [&](const auto& b) { return b == boot; });
  std::int64_t fewest = isOneMachine ? std::thread::hardware_concurrency() : 0;
  allReduce(comm, std::span{&fewest, 1}, MPI_MIN);
  return static_cast<int>(fewest);
}

}  // namespace burin::host::bench
