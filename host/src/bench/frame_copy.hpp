#pragma once

#include <algorithm>

#include "burin/common/image.hpp"

namespace burin::host::bench {

/// The pixels of a frame in memory of their own: the FrameMaker's are overwritten by its next one.
inline Image<Rgba> copyOf(ImageView<const Rgba> frame) {
  Image<Rgba> image{frame.size()};
  std::ranges::copy(frame.pixels(), image.pixels().begin());
  return image;
}

}  // namespace burin::host::bench
