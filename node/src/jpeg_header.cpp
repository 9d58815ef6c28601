#include "jpeg_header.hpp"

namespace burin::node {
namespace {

/// Codes of markers, which stand behind a byte of all ones.
constexpr int kStartOfImage = 0xd8;
constexpr int kQuantisation = 0xdb;  // the first of the segments of tables
constexpr int kExpand = 0xdf;        // the last
constexpr int kApplication = 0xe0;
constexpr int kComment = 0xfe;

/// SOF0 … SOF15, but for what has such a code and is none: tables (DHT, DAC), extensions (JPG).
bool isFrameHeader(int code) {
  return code >= 0xc0 && code <= 0xcf && code != 0xc4 && code != 0xc8 && code != 0xcc;
}

/// Of those that may stand before a frame's header.
bool hasLength(int code) {
  return code == 0xc4 || code == 0xc8 || code == 0xcc ||
         (code >= kQuantisation && code <= kExpand) || (code >= kApplication && code <= kComment);
}

}  // namespace

bool hasJpegFrameHeader(std::span<const std::byte> bytes) {
  const auto at = [&](std::size_t i) { return std::to_integer<int>(bytes[i]); };
  constexpr std::size_t kMarker = 2;
  constexpr std::size_t kFrame = 8;  // up to its number of components
  if (bytes.size() < kMarker || at(0) != 0xff || at(1) != kStartOfImage) return false;
  for (std::size_t i = kMarker; i + kMarker + kFrame <= bytes.size();) {
    if (at(i) != 0xff) return false;
    if (isFrameHeader(at(i + 1))) return true;
    if (!hasLength(at(i + 1))) return false;
    const auto length = static_cast<std::size_t>(256 * at(i + 2) + at(i + 3));  // with itself
    if (length < 2) return false;
    i += kMarker + length;
  }
  return false;
}

}  // namespace burin::node
