#include "burin/common/memory_room.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace burin {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

/// The number after `word` in a file of words and numbers ("MemAvailable:  1024 kB").
std::optional<std::int64_t> numberAfter(const fs::path& file, std::string_view word) {
  std::ifstream in{file};
  for (std::string next; in >> next;) {
    std::int64_t number = 0;
    if (next == word && in >> number) return number;
  }
  return std::nullopt;
}

/// A file that holds one number; none if it holds a word ("max").
std::optional<std::int64_t> numberIn(const fs::path& file) {
  std::ifstream in{file};
  std::int64_t number = 0;
  return in >> number ? std::optional{number} : std::nullopt;
}

std::int64_t addressSpaceLeft(const fs::path& root) {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kNoLimit;
  const auto inUse = 1024 * numberAfter(root / "proc/self/status", "VmSize:").value_or(0);
  return std::max<std::int64_t>(0, static_cast<std::int64_t>(limit.rlim_cur) - inUse);
}

/// What the two versions of control groups call their numbers.
struct GroupFiles {
  fs::path mount;
  const char *limit, *usage, *cache;  ///< `cache`: in memory.stat; memory that would be given back
};

/// Room in a group and all those it is in, whose limits hold as well.
std::int64_t groupRoom(const GroupFiles& files, fs::path group) {
  std::int64_t room = kNoLimit;
  for (group = group.relative_path();; group = group.parent_path()) {
    const fs::path folder = files.mount / group;
    const auto limit = numberIn(folder / files.limit);
    const auto usage = numberIn(folder / files.usage);
    if (limit && usage) {
      const auto cache = numberAfter(folder / "memory.stat", files.cache).value_or(0);
      room = std::min(room, std::max<std::int64_t>(0, *limit - (*usage - cache)));
    }
    if (group.empty()) return room;
  }
}

/// /proc/self/cgroup has lines "number:controllers:group"; version 2 has number 0 and no
/// controllers.
std::int64_t groupsRoom(const fs::path& root) {
  const fs::path mounts = root / "sys/fs/cgroup";
  std::int64_t room = kNoLimit;
  std::ifstream in{root / "proc/self/cgroup"};
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = fmt::format(",{},", line.substr(first + 1, second - first - 1));
    const fs::path group = line.substr(second + 1);
    if (controllers == ",,")
      room = std::min(room,
                      groupRoom({mounts, "memory.max", "memory.current", "inactive_file"}, group));
    if (controllers.find(",memory,") != std::string::npos)
      room = std::min(room, groupRoom({mounts / "memory", "memory.limit_in_bytes",
                                       "memory.usage_in_bytes", "total_inactive_file"},
                                      group));
  }
  return room;
}

std::int64_t freeMemory(const fs::path& root) {
  const fs::path file = root / "proc/meminfo";
  const auto available = numberAfter(file, "MemAvailable:");
  if (!available) return kNoLimit;
  return 1024 * (*available + numberAfter(file, "SwapFree:").value_or(0));
}

}  // namespace

MemoryRoom memoryRoom(const fs::path& root) {
  return {addressSpaceLeft(root), std::min(freeMemory(root), groupsRoom(root))};
}

std::string byteText(std::int64_t bytes) {
  constexpr const char* kUnits[] = {"bytes", "KiB", "MiB", "GiB", "TiB"};
  auto amount = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; amount >= 1024 && unit + 1 < std::size(kUnits); ++unit) amount /= 1024;
  return fmt::format("{:.{}f} {}", amount, unit > 0 && amount < 10 ? 1 : 0, kUnits[unit]);
}

}  // namespace burin
