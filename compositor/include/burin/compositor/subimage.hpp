#pragma once

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

}  // namespace burin::compositor
