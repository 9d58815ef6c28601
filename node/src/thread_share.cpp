#include "burin/node/thread_share.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>

#include "burin/common/hosts.hpp"
#include "burin/common/log.hpp"

namespace burin::node {
namespace {

struct Seat {
  cpu_set_t mask;
  int drawing;
};

}  // namespace

int threadShare(const Communicator& comm, bool drawing) {
  Seat mine{};
  CPU_ZERO(&mine.mask);
  if (sched_getaffinity(0, sizeof(mine.mask), &mine.mask) != 0) CPU_SET(0, &mine.mask);
  mine.drawing = drawing ? 1 : 0;
  const std::vector<int> hosts = hostsOf(comm);
  const auto self = static_cast<std::size_t>(comm.rank());
  const std::vector<Seat> seats = allGather(comm, mine);
  int onHost = 0;
  int sameMask = 0;
  for (std::size_t rank = 0; rank < seats.size(); ++rank) {
    const Seat& seat = seats[rank];
    if (hosts[rank] != hosts[self] || seat.drawing == 0) continue;
    ++onHost;
    if (CPU_EQUAL(&seat.mask, &mine.mask)) ++sameMask;
  }
  const int cpus = CPU_COUNT(&mine.mask);
  const int hostCpus = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  const int share = onHost > 0 ? hostCpus / onHost : hostCpus;
  if (drawing && cpus / std::max(sameMask, 1) < share && hosts[self] == static_cast<int>(self))
    warn(
        "each rank may use {} of this host's {} CPUs, {} would be its share; start mpirun with "
        "--bind-to none",
        cpus, hostCpus, share);
  return std::max(1, cpus / std::max(sameMask, 1));
}

}  // namespace burin::node
