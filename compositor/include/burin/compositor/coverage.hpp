#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "burin/compositor/sparse_tile.hpp"

namespace burin::compositor {

/// Which share of each cell of the frame a rank has active pixels in, in 255ths rounded up (so that
/// one pixel counts). A cell is a tile, or in very large frames a few consecutive ones, so that the
/// coverage is a message of one small size whatever the frame.
class Coverage {
 public:
  static constexpr std::size_t kCells = TileGrid::kUsualTiles;

  /// Consecutive tiles per cell.
  static std::size_t tilesPerCell(const TileGrid& grid) {
    return (grid.count() + kCells - 1) / kCells;
  }

  std::uint8_t& operator[](std::size_t cell) { return share_[cell]; }
  std::uint8_t operator[](std::size_t cell) const { return share_[cell]; }

 private:
  std::array<std::uint8_t, kCells> share_{};
};

template <typename Pixel>
Coverage coverageOf(const SparseImage<Pixel>& image, const TileGrid& grid) {
  Coverage coverage;
  const std::size_t step = Coverage::tilesPerCell(grid);
  for (std::size_t begin = 0, cell = 0; begin < image.size(); begin += step, ++cell) {
    std::size_t active = 0;
    std::size_t pixels = 0;
    for (std::size_t tile = begin; tile < std::min(begin + step, image.size()); ++tile) {
      active += image[tile].active;
      pixels += grid.pixels(tile);
    }
    coverage[cell] = static_cast<std::uint8_t>((active * 255 + pixels - 1) / pixels);
  }
  return coverage;
}

}  // namespace burin::compositor
