#pragma once

#include <cstddef>
#include <span>

#include "burin/compositor/active_area.hpp"

namespace burin::compositor {

/// Every message between ranks is a header and then the pixels of an ActiveArea in storage order.
/// The header, in the machine's byte order, says which pixels: u32 mark · i32 x0, y0, x1, y1 of the
/// rectangle · u32 bytes per pixel · u64 begin, end of the region.
inline constexpr std::size_t kShareHeaderBytes = 40;

/// Bytes of the message for `pixels` pixels.
constexpr std::size_t shareBytes(std::size_t pixels, std::size_t pixelBytes) {
  return kShareHeaderBytes + pixels * pixelBytes;
}

void writeShareHeader(const ActiveArea& area, std::size_t pixelBytes,
                      std::span<std::byte, kShareHeaderBytes> out);

/// The area that `message` carries, which is inside `bounds` and has exactly the pixels that follow
/// the header. Throws Error{kRank} if the message is damaged or is not for `region`.
ActiveArea readShareHeader(std::span<const std::byte> message, const PixelRect& bounds,
                           const Region& region, std::size_t pixelBytes);

}  // namespace burin::compositor
