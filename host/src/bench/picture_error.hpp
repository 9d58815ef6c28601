#pragma once

#include "burin/common/image.hpp"

namespace burin::host::bench {

/// How far a picture is from the right one.
struct PictureError {
  double largest = 0;  ///< of premultiplied linear RGBA, over all channels and pixels
  double rms = 0;
  /// 99.9th percentile over the pixels of the CIE 1976 colour difference on white, as displayed: 1
  /// is about what an eye can just tell apart.
  double deltaE = 0;
};

/// Local. Both of one size.
PictureError pictureError(ImageView<const Rgba> picture, ImageView<const Rgba> truth);

}  // namespace burin::host::bench
