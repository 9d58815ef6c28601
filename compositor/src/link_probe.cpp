#include "burin/compositor/link_probe.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace burin::compositor {

namespace {

/// Large enough that a shaped link's burst allowance and the latency do not hide its rate.
constexpr std::size_t kBytes = std::size_t{256} << 10;
constexpr int kProbeTag = 3;

}  // namespace

double measureLink(const Communicator& comm) {
  if (comm.size() == 1) return std::numeric_limits<double>::infinity();
  const int self = static_cast<int>(comm.rank());
  const int next = (self + 1) % comm.size();
  const int previous = (self + comm.size() - 1) % comm.size();
  const std::vector<std::byte> out(kBytes);
  std::vector<std::byte> in(kBytes);
  barrier(comm);
  const auto start = std::chrono::steady_clock::now();
  std::array<MPI_Request, 2> requests{};
  checkMpi(MPI_Irecv(in.data(), mpiCount(in.size()), MPI_BYTE, previous, kProbeTag, comm.get(),
                     &requests[0]),
           "MPI_Irecv");
  checkMpi(MPI_Isend(out.data(), mpiCount(out.size()), MPI_BYTE, next, kProbeTag, comm.get(),
                     &requests[1]),
           "MPI_Isend");
  waitIdle(requests, "the link to be measured");
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  double rate = static_cast<double>(kBytes) / std::max(seconds.count(), 1e-9);
  allReduce(comm, std::span{&rate, 1}, MPI_MIN);
  return rate;
}

}  // namespace burin::compositor
