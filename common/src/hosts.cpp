#include "burin/common/hosts.hpp"

namespace burin {

std::vector<int> hostsOf(const Communicator& comm) {
  MPI_Comm shared = MPI_COMM_NULL;
  checkMpi(MPI_Comm_split_type(comm.get(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &shared),
           "MPI_Comm_split_type");
  const Communicator host{shared};
  MPI_Comm_free(&shared);
  std::int64_t lowest = static_cast<int>(comm.rank());
  allReduce(host, std::span{&lowest, 1}, MPI_MIN);
  return allGather(comm, static_cast<int>(lowest));
}

}  // namespace burin
