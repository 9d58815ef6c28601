#pragma once

#include <span>
#include <vector>

#include "burin/common/image.hpp"

namespace burin::compositor {

/// The pixels one rank produced, of a frame of size `frame`: those of the rectangle `active`, row
/// by row; every other pixel of the frame is the algebra's identity.
template <typename Pixel>
struct Subimage {
  ImageSize frame;
  PixelRect active;
  std::vector<Pixel> pixels;  ///< active.pixels() of them
};

/// The same, its pixels somewhere else: in memory of Compositor::canvas() they need not be copied
/// to be read by other ranks of the host.
template <typename Pixel>
struct SubimageView {
  ImageSize frame;
  PixelRect active;
  std::span<const Pixel> pixels;

  SubimageView(ImageSize size, const PixelRect& rect, std::span<const Pixel> drawn)
      : frame{size}, active{rect}, pixels{drawn} {}
  SubimageView(const Subimage<Pixel>& image)
      : frame{image.frame}, active{image.active}, pixels{image.pixels} {}
};

}  // namespace burin::compositor
