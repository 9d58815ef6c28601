#pragma once

#include <cstddef>
#include <span>

namespace burin::node {

/// Whether bytes begin as a JPEG image does: a start of image, then segments of the lengths they
/// say, one of which is the header of a frame (ITU-T T.81, B.1.1 and B.2.1).
bool hasJpegFrameHeader(std::span<const std::byte> bytes);

}  // namespace burin::node
