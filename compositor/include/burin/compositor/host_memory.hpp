#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/compositor/shared_spaces.hpp"

namespace burin::compositor {

/// What a rank tells the others of the memory it shares. No padding: it is sent as bytes.
struct MemoryNotice {
  std::int32_t process = 0;
  std::int32_t descriptor = -1;
  std::uint64_t bytes = 0;
  std::uint64_t generation = 0;  ///< grows with every new memory
  std::uint64_t device = 0;      ///< with the inode: which file it is, whatever a path leads to
  std::uint64_t inode = 0;
};

/// Memory of this rank that the other ranks on its host read and write without copying: an
/// anonymous file (memfd) that they open through /proc, so that nothing is left over however the
/// processes end. Pages are used only when written to. Where a host does not allow it, nothing is
/// shared.
class HostMemory {
 public:
  /// Collective. Finds out which ranks are on one host and whether they can read each other.
  /// `bytes`: what this rank shares at once, zeros.
  explicit HostMemory(const Communicator& comm, std::size_t bytes = 4096);
  HostMemory(const HostMemory&) = delete;
  HostMemory& operator=(const HostMemory&) = delete;
  ~HostMemory();

  /// Number of hosts the ranks are on.
  int hosts() const { return hosts_; }
  bool isSharing() const { return isSharing_; }

  /// Local. Makes sure that at least `bytes` are there; what was in them is lost if they are new.
  /// Throws Error{kRank}.
  void reserve(std::size_t bytes);
  /// To be told to all ranks after reserve().
  MemoryNotice notice() const;
  /// Local. Whether attach() has anything to do on any rank.
  bool isNews(std::span<const MemoryNotice> byRank) const;
  /// Local. Maps the memories that are new. Throws Error{kRank}.
  void attach(std::span<const MemoryNotice> byRank);
  /// Local. After attach() failed on any rank: all memories are news again, on all ranks alike.
  void detach();

  std::span<std::byte> own() const { return own_.bytes; }
  /// A rank's memory as attached, to be written to where the ranks agreed on; empty if that rank is
  /// on another host.
  std::span<std::byte> of(Rank rank) const {
    return rank == rank_ ? own_.bytes : neighbours_[static_cast<std::size_t>(rank)].bytes;
  }
  const SharedSpaces& spaces() const { return spaces_; }

 private:
  /// A mapped file.
  struct Mapping {
    int descriptor = -1;  ///< of an own one
    std::uint64_t device = 0, inode = 0;
    std::uint64_t generation = 0;
    std::span<std::byte> bytes;
  };
  static void unmap(Mapping& mapping);

  Rank rank_;
  int hosts_ = 1;
  bool isSharing_ = false;
  std::vector<bool> isNeighbour_;  ///< by rank; this one is none
  Mapping own_;
  std::vector<std::uint64_t> generations_;  ///< by rank, as attached
  std::vector<Mapping> neighbours_;         ///< by rank
  SharedSpaces spaces_;
};

}  // namespace burin::compositor
