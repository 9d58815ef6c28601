#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace burin::compositor {

/// Bytes in the memory of a rank that others on its host can read.
struct SharedPlace {
  std::int32_t rank = -1;
  std::uint64_t offset = 0;
};

/// The memories that this process and others on its host can read, by rank; a rank that shares
/// nothing with us has an empty one. What is passed by reference is a place in one of them.
class SharedSpaces {
 public:
  SharedSpaces() = default;
  explicit SharedSpaces(std::vector<std::span<const std::byte>> byRank)
      : byRank_{std::move(byRank)} {}

  /// Whether pixels can be passed to and from `rank` by reference.
  bool reaches(int rank) const { return !of(rank).empty(); }
  std::span<const std::byte> of(int rank) const {
    const auto index = static_cast<std::size_t>(rank);
    return index < byRank_.size() ? byRank_[index] : std::span<const std::byte>{};
  }
  /// Where `bytes` lie, if in one of the memories.
  std::optional<SharedPlace> find(std::span<const std::byte> bytes) const;
  /// What lies there; nullopt unless all of it is inside that rank's memory.
  std::optional<std::span<const std::byte>> at(SharedPlace place, std::size_t bytes) const;

 private:
  std::vector<std::span<const std::byte>> byRank_;
};

}  // namespace burin::compositor
