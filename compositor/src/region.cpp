#include "burin/compositor/region.hpp"

#include <algorithm>

#include "burin/common/error.hpp"

namespace burin::compositor {

Region piece(const Region& region, std::size_t index, std::size_t pieces) {
  BURIN_CHECK(index < pieces);
  const std::size_t size = region.pixels() / pieces;
  const std::size_t larger = region.pixels() % pieces;  // the first so many get one pixel more
  const std::size_t begin = region.begin + index * size + std::min(index, larger);
  return {begin, begin + size + (index < larger ? 1 : 0)};
}

}  // namespace burin::compositor
