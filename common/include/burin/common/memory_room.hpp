#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace burin {

/// How many bytes more can be had, by what the system declares.
struct MemoryRoom {
  /// This process alone: what its address space may still grow by (`ulimit -v`).
  std::int64_t process;
  /// All processes of this host together: free memory, what caches would give back, and swap; less
  /// if a control group (a container, a batch job) sets a smaller limit.
  std::int64_t host;
};

/// Numbers that cannot be read count as no limit. `root`: of the folders proc and sys, for tests.
MemoryRoom memoryRoom(const std::filesystem::path& root = "/");

/// "512 KiB", "3.4 GiB": two digits that mean something.
std::string byteText(std::int64_t bytes);

}  // namespace burin
