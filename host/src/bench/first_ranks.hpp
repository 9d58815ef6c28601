#pragma once

#include <optional>

#include "burin/common/communicator.hpp"

namespace burin::host::bench {

/// The first `ranks` ranks of `comm`; nullopt on the others. Collective over `comm`.
inline std::optional<Communicator> firstRanks(const Communicator& comm, int ranks) {
  const int colour = static_cast<int>(comm.rank()) < ranks ? 0 : MPI_UNDEFINED;
  MPI_Comm part = MPI_COMM_NULL;
  checkMpi(MPI_Comm_split(comm.get(), colour, 0, &part), "MPI_Comm_split");
  if (part == MPI_COMM_NULL) return std::nullopt;
  Communicator first{part};
  checkMpi(MPI_Comm_free(&part), "MPI_Comm_free");
  return first;
}

}  // namespace burin::host::bench
