#include "burin/common/memory_check.hpp"

#include "burin/common/error.hpp"
#include "burin/common/hosts.hpp"
#include "burin/common/memory_room.hpp"

namespace burin {

void checkMemory(const Communicator& comm, const MemoryNeed& mine) {
  const std::vector<int> hosts = hostsOf(comm);
  const std::vector<std::int64_t> needs = allGather(comm, mine.bytes);
  const auto self = static_cast<std::size_t>(comm.rank());
  std::int64_t ofHost = 0;
  for (std::size_t rank = 0; rank < hosts.size(); ++rank)
    if (hosts[rank] == hosts[self]) ofHost += needs[rank];
  collectively(comm, "memory", [&] {
    if (mine.bytes == 0) return;
    const MemoryRoom room = memoryRoom();
    if (mine.bytes > room.process)
      fail(ExitCode::kRank, "{} needs {}, the limit of the address space (ulimit -v) leaves {}",
           mine.purpose, byteText(mine.bytes), byteText(room.process));
    if (ofHost > room.host)
      fail(ExitCode::kRank, "{} needs {}, all ranks of this host {}; it has {} left", mine.purpose,
           byteText(mine.bytes), byteText(ofHost), byteText(room.host));
  });
}

}  // namespace burin
