#include "chessboard_distance.hpp"

#include <algorithm>
#include <bit>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

/// A grid of bits, rows of x padded to whole words with zeros.
struct Bits {
  glm::ivec3 size;
  std::size_t words;  ///< per row
  std::vector<std::uint64_t> bits;

  explicit Bits(const glm::ivec3& gridSize)
      : size{gridSize},
        words{(static_cast<std::size_t>(gridSize.x) + 63) / 64},
        bits(words * rows()) {}
  std::size_t rows() const {
    return static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
  }
  /// Which bits of the last word of a row are cells.
  std::uint64_t tail() const {
    const int used = size.x % 64;
    return used == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << used) - 1;
  }
};

/// Marks the neighbours of marked cells along x.
void spreadX(const Bits& from, Bits& to) {
  for (std::size_t row = 0; row < from.rows(); ++row) {
    const std::uint64_t* in = from.bits.data() + row * from.words;
    std::uint64_t* out = to.bits.data() + row * from.words;
    for (std::size_t w = 0; w < from.words; ++w) {
      std::uint64_t word = in[w] | (in[w] << 1) | (in[w] >> 1);
      if (w > 0) word |= in[w - 1] >> 63;
      if (w + 1 < from.words) word |= in[w + 1] << 63;
      out[w] = word;
    }
    out[from.words - 1] &= from.tail();
  }
}

/// The same for rows `stride` apart in lines of `count` rows, in place.
void spreadRows(Bits& grid, std::size_t stride, int count, std::vector<std::uint64_t>& before) {
  const std::size_t block = stride * grid.words;  // words between neighbours
  const std::size_t line = block * static_cast<std::size_t>(count);
  before.resize(block);
  for (std::size_t start = 0; start < grid.bits.size(); start += line) {
    std::ranges::fill(before, 0);
    for (std::size_t at = start; at < start + line; at += block) {
      const bool last = at + block == start + line;
      for (std::size_t w = 0; w < block; ++w) {
        const std::uint64_t own = grid.bits[at + w];
        grid.bits[at + w] |= before[w] | (last ? 0 : grid.bits[at + block + w]);
        before[w] = own;
      }
    }
  }
}

/// Writes sign * distance for every cell outside `grid`, which grows by one cell at a time.
void measure(Bits grid, int sign, const glm::ivec3& size, std::span<std::int8_t> distances) {
  Bits grown{size};
  std::vector<std::uint64_t> before;
  const auto width = static_cast<std::size_t>(size.x);
  for (int distance = 1; distance < kLargestDistance; ++distance) {
    spreadX(grid, grown);
    spreadRows(grown, 1, size.y, before);
    spreadRows(grown, static_cast<std::size_t>(size.y), size.z, before);
    bool any = false;
    for (std::size_t i = 0; i < grid.bits.size(); ++i) {
      const std::size_t row = i / grid.words;
      const std::size_t first = row * width + i % grid.words * 64;
      for (std::uint64_t added = grown.bits[i] & ~grid.bits[i]; added != 0; added &= added - 1) {
        distances[first + static_cast<std::size_t>(std::countr_zero(added))] =
            static_cast<std::int8_t>(sign * distance);
        any = true;
      }
    }
    if (!any) return;
    std::swap(grid, grown);
  }
}

}  // namespace

std::vector<std::int8_t> signedChessboardDistance(std::span<const std::uint8_t> marked,
                                                  const glm::ivec3& size) {
  Bits grid{size};
  BURIN_CHECK_EQ(marked.size(), grid.rows() * static_cast<std::size_t>(size.x));
  Bits others{size};
  std::vector<std::int8_t> distances(marked.size());
  std::size_t cell = 0;
  for (std::size_t row = 0; row < grid.rows(); ++row)
    for (std::size_t x = 0; x < static_cast<std::size_t>(size.x); ++x, ++cell) {
      Bits& kind = marked[cell] != 0 ? grid : others;
      kind.bits[row * grid.words + x / 64] |= std::uint64_t{1} << (x % 64);
      distances[cell] =
          static_cast<std::int8_t>(marked[cell] != 0 ? -kLargestDistance : kLargestDistance);
    }
  measure(std::move(grid), 1, size, distances);
  measure(std::move(others), -1, size, distances);
  return distances;
}

}  // namespace burin::node
