#include "burin/node/thread_share.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>

#include "burin/common/log.hpp"

namespace burin::node {
namespace {

struct Seat {
  cpu_set_t mask;
  int drawing;
  std::int64_t host;  ///< rank of the host's first member: which host a rank sits on
};

std::int64_t hostOf(const Communicator& comm) {
  MPI_Comm shared = MPI_COMM_NULL;
  checkMpi(MPI_Comm_split_type(comm.get(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &shared),
           "MPI_Comm_split_type");
  const Communicator host{shared};
  MPI_Comm_free(&shared);
  std::int64_t first = static_cast<int>(comm.rank());
  allReduce(host, std::span{&first, 1}, MPI_MIN);
  return first;
}

}  // namespace

int threadShare(const Communicator& comm, bool drawing) {
  Seat mine{};
  CPU_ZERO(&mine.mask);
  if (sched_getaffinity(0, sizeof(mine.mask), &mine.mask) != 0) CPU_SET(0, &mine.mask);
  mine.drawing = drawing ? 1 : 0;
  mine.host = hostOf(comm);
  int onHost = 0;
  int sameMask = 0;
  for (const Seat& seat : allGather(comm, mine)) {
    if (seat.host != mine.host || seat.drawing == 0) continue;
    ++onHost;
    if (CPU_EQUAL(&seat.mask, &mine.mask)) ++sameMask;
  }
  const int cpus = CPU_COUNT(&mine.mask);
  const int hostCpus = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  const int share = onHost > 0 ? hostCpus / onHost : hostCpus;
  if (drawing && cpus / std::max(sameMask, 1) < share && mine.host == static_cast<int>(comm.rank()))
    warn(
        "each rank may use {} of this host's {} CPUs, {} would be its share; start mpirun with "
        "--bind-to none",
        cpus, hostCpus, share);
  return std::max(1, cpus / std::max(sameMask, 1));
}

}  // namespace burin::node
