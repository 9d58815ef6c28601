#pragma once

#include <cstddef>

namespace burin::compositor {

/// Half-open range [begin, end) of pixel numbers. Pixels are numbered row by row, not in the whole
/// frame but in its `bounds`: the rectangle around everything any rank drew.
struct Region {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t pixels() const { return empty() ? 0 : end - begin; }
  bool empty() const { return end <= begin; }
  bool contains(const Region& other) const {
    return other.empty() || (begin <= other.begin && other.end <= end);
  }
  friend bool operator==(const Region&, const Region&) = default;
};

/// Piece `index` (0 …) of `pieces` consecutive ones whose sizes differ by at most one pixel.
Region piece(const Region& region, std::size_t index, std::size_t pieces);

}  // namespace burin::compositor
