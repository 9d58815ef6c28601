#pragma once

#include <cstddef>

#include "burin/common/image.hpp"

namespace burin::compositor {

/// The frame cut into tiles, numbered row by row: what ranks exchange is whole tiles. Those at the
/// right and bottom border are smaller. Follows from the frame's size alone, so that all ranks cut
/// alike without talking.
class TileGrid {
 public:
  /// At most this many tiles while a tile can hold the frame's share: a rank's coverage of all
  /// tiles, a byte each, is then a message without noticeable cost.
  static constexpr std::size_t kUsualTiles = 1024;
  /// Pixel places in a tile fit in 16 bits.
  static constexpr std::size_t kMostTilePixels = 65536;

  TileGrid() = default;
  explicit TileGrid(ImageSize frame);

  ImageSize frame() const { return frame_; }
  std::size_t count() const {
    return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int tileWidth() const { return tileWidth_; }
  int tileHeight() const { return tileHeight_; }
  /// The pixels of a tile in the frame. Places in a tile count row by row in this rectangle.
  PixelRect rect(std::size_t tile) const;
  std::size_t pixels(std::size_t tile) const { return rect(tile).pixels(); }
  friend bool operator==(const TileGrid&, const TileGrid&) = default;

 private:
  ImageSize frame_{0, 0};
  int tileWidth_ = 1, tileHeight_ = 1;
  int columns_ = 0, rows_ = 0;
};

}  // namespace burin::compositor
