#pragma once

#include <cstddef>

namespace burin::compositor {

/// Half-open range [begin, end) of positions in the frame's sequence of tiles
/// (tile_assignment.hpp): what ranks give each other is always some consecutive tiles of that
/// sequence.
struct Region {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t length() const { return empty() ? 0 : end - begin; }
  bool empty() const { return end <= begin; }
  bool contains(const Region& other) const {
    return other.empty() || (begin <= other.begin && other.end <= end);
  }
  friend bool operator==(const Region&, const Region&) = default;
};

}  // namespace burin::compositor
