// netlab_probe RANKS_PER_HOST SECONDS MEGABYTES: fails unless MPI takes the ranks for
// RANKS_PER_HOST on each host, and a message of MEGABYTES (10^6 bytes) from the first rank to the
// last takes SECONDS or longer. Run by netlab_test through scripts/netlab.

#include <fmt/format.h>
#include <mpi.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "burin/common/communicator.hpp"

namespace {

using namespace burin;

/// Collective. The ranks that could share memory with this one.
int ranksOnThisHost(const Communicator& comm) {
  MPI_Comm host = MPI_COMM_NULL;
  checkMpi(MPI_Comm_split_type(comm.get(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host),
           "MPI_Comm_split_type");
  int ranks = 0;
  checkMpi(MPI_Comm_size(host, &ranks), "MPI_Comm_size");
  checkMpi(MPI_Comm_free(&host), "MPI_Comm_free");
  return ranks;
}

/// Collective. How many names the ranks' hosts have among them.
int hostNames(const Communicator& comm) {
  std::array<char, MPI_MAX_PROCESSOR_NAME> mine{};
  int length = 0;
  checkMpi(MPI_Get_processor_name(mine.data(), &length), "MPI_Get_processor_name");
  const auto all = allGatherBytes(comm, std::as_bytes(std::span{mine}));
  std::set<std::vector<std::byte>> names;
  for (std::size_t at = 0; at < all.size(); at += mine.size()) {
    const auto name = std::span{all}.subspan(at, mine.size());
    names.emplace(name.begin(), name.end());
  }
  return static_cast<int>(names.size());
}

/// Collective. Seconds from the first rank's sending `bytes` to the last one's word that it has
/// them; 0 on the other ranks.
double sendingTime(const Communicator& comm, std::size_t bytes) {
  const int last = comm.size() - 1;
  const int count = mpiCount(bytes);
  std::vector<std::byte> message(bytes);
  MPI_Request request = MPI_REQUEST_NULL;
  const auto wait = [&](int code, const char* call) {
    checkMpi(code, call);
    waitIdle(request);
  };
  barrier(comm);
  const double start = MPI_Wtime();
  if (comm.isRoot()) {
    wait(MPI_Isend(message.data(), count, MPI_BYTE, last, 0, comm.get(), &request), "MPI_Isend");
    wait(MPI_Irecv(nullptr, 0, MPI_BYTE, last, 0, comm.get(), &request), "MPI_Irecv");
    return MPI_Wtime() - start;
  }
  if (static_cast<int>(comm.rank()) == last) {
    wait(MPI_Irecv(message.data(), count, MPI_BYTE, 0, 0, comm.get(), &request), "MPI_Irecv");
    wait(MPI_Isend(nullptr, 0, MPI_BYTE, 0, 0, comm.get(), &request), "MPI_Isend");
  }
  return 0.0;
}

/// Collective. @returns whether all is as it should be; rank 0's word counts, apart from its
/// host's.
bool probe(const Communicator& comm, int ranksPerHost, double seconds, double megabytes) {
  const int shared = ranksOnThisHost(comm);
  const int hosts = hostNames(comm);
  const double taken = sendingTime(comm, static_cast<std::size_t>(megabytes * 1e6));
  if (comm.isRoot()) {
    fmt::print(
        "{} hosts, {} ranks on the first; {} MB from rank 0 to {} in {:.3f} s, {:.2f} MB/s\n",
        hosts, shared, megabytes, comm.size() - 1, taken, megabytes / taken);
  }
  const bool slowEnough = !comm.isRoot() || taken >= seconds;
  return shared == ranksPerHost && hosts * ranksPerHost == comm.size() && slowEnough;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const MpiRuntime runtime{&argc, &argv};
    const Communicator comm{MPI_COMM_WORLD};
    if (argc != 4 || comm.size() < 2)
      throw std::runtime_error{"give three numbers, on two ranks or more"};
    return probe(comm, std::stoi(argv[1]), std::stod(argv[2]), std::stod(argv[3])) ? 0 : 1;
  } catch (const std::exception& e) {
    fmt::print(stderr, "netlab_probe: {}\n", e.what());
    return 1;
  }
}
