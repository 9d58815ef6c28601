#include "burin/compositor/host_memory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "burin/common/hosts.hpp"

namespace burin::compositor {

namespace {

std::string systemError() {
  return std::strerror(errno);
}

std::span<std::byte> mapped(int descriptor, std::size_t bytes) {
  void* const address = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  if (address == MAP_FAILED) {
    fail(ExitCode::kRank, "{} bytes of shared memory: {}", bytes, systemError());
  }
  return {static_cast<std::byte*>(address), bytes};
}

struct stat factsOf(int descriptor) {
  struct stat facts {};
  if (fstat(descriptor, &facts) != 0) fail(ExitCode::kRank, "fstat: {}", systemError());
  return facts;
}

/// Another process's memory. Where processes number each other differently (containers), the path
/// leads to some other file or to none.
std::span<std::byte> mappedOf(const MemoryNotice& notice) {
  const auto path = fmt::format("/proc/{}/fd/{}", notice.process, notice.descriptor);
  const int descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) fail(ExitCode::kRank, "{}: {}", path, systemError());
  std::span<std::byte> bytes;
  const Outcome outcome = attempt([&] {
    const struct stat facts = factsOf(descriptor);
    if (facts.st_dev != notice.device || facts.st_ino != notice.inode) {
      fail(ExitCode::kRank, "{}: not the memory that was meant", path);
    }
    bytes = mapped(descriptor, static_cast<std::size_t>(notice.bytes));
  });
  close(descriptor);
  if (outcome.failed) throw Error{outcome.code, outcome.reason};
  return bytes;
}

}  // namespace

HostMemory::HostMemory(const Communicator& comm, std::size_t bytes)
    : rank_{comm.rank()},
      isNeighbour_(static_cast<std::size_t>(comm.size()), false),
      generations_(static_cast<std::size_t>(comm.size()), 0),
      neighbours_(static_cast<std::size_t>(comm.size())) {
  const auto hosts = hostsOf(comm);
  auto distinct = hosts;
  std::ranges::sort(distinct);
  hosts_ = static_cast<int>(std::unique(distinct.begin(), distinct.end()) - distinct.begin());
  for (std::size_t i = 0; i < hosts.size(); ++i) {
    isNeighbour_[i] =
        hosts[i] == hosts[static_cast<std::size_t>(rank_)] && Rank{static_cast<int>(i)} != rank_;
  }
  // The first memory tells whether a host lets its processes share; all ranks take the same way.
  Outcome trial = attempt([&] { reserve(bytes); });
  const auto notices = allGather(comm, trial.failed ? MemoryNotice{} : notice());
  if (!trial.failed) trial = attempt([&] { attach(notices); });
  std::int64_t works = trial.failed ? 0 : 1;
  allReduce(comm, std::span{&works, 1}, MPI_MIN);
  isSharing_ = works == 1 && hosts_ < comm.size();
  if (!isSharing_) spaces_ = {};
}

HostMemory::~HostMemory() {
  unmap(own_);
  for (Mapping& mapping : neighbours_) unmap(mapping);
}

void HostMemory::unmap(Mapping& mapping) {
  if (!mapping.bytes.empty()) munmap(mapping.bytes.data(), mapping.bytes.size());
  if (mapping.descriptor >= 0) close(mapping.descriptor);
  mapping = {};
}

void HostMemory::reserve(std::size_t bytes) {
  if (bytes <= own_.bytes.size()) return;
  Mapping larger;
  larger.descriptor = memfd_create("burin", MFD_CLOEXEC);
  larger.generation = own_.generation + 1;
  if (larger.descriptor < 0) fail(ExitCode::kRank, "memfd_create: {}", systemError());
  try {
    if (ftruncate(larger.descriptor, static_cast<off_t>(bytes)) != 0) {
      fail(ExitCode::kRank, "{} bytes of shared memory: {}", bytes, systemError());
    }
    const struct stat facts = factsOf(larger.descriptor);
    larger.device = facts.st_dev;
    larger.inode = facts.st_ino;
    larger.bytes = mapped(larger.descriptor, bytes);
  } catch (...) {
    unmap(larger);
    throw;
  }
  unmap(own_);
  own_ = larger;
}

MemoryNotice HostMemory::notice() const {
  return {static_cast<std::int32_t>(getpid()),
          own_.descriptor,
          own_.bytes.size(),
          own_.generation,
          own_.device,
          own_.inode};
}

bool HostMemory::isNews(std::span<const MemoryNotice> byRank) const {
  return !std::ranges::equal(byRank, generations_, {}, &MemoryNotice::generation);
}

void HostMemory::attach(std::span<const MemoryNotice> byRank) {
  std::vector<std::span<const std::byte>> spaces(byRank.size());
  for (std::size_t i = 0; i < byRank.size(); ++i) {
    const MemoryNotice& notice = byRank[i];
    generations_[i] = notice.generation;
    if (Rank{static_cast<int>(i)} == rank_) spaces[i] = own_.bytes;
    if (!isNeighbour_[i] || notice.descriptor < 0) continue;
    Mapping& mapping = neighbours_[i];
    if (mapping.generation != notice.generation) {
      unmap(mapping);
      mapping.bytes = mappedOf(notice);
      mapping.generation = notice.generation;
    }
    spaces[i] = mapping.bytes;
  }
  spaces_ = SharedSpaces{std::move(spaces)};
}

void HostMemory::detach() {
  std::ranges::fill(generations_, 0U);
  for (Mapping& mapping : neighbours_) unmap(mapping);
  spaces_ = {};
}

}  // namespace burin::compositor
