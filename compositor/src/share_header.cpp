#include "burin/compositor/share_header.hpp"

#include <cstdint>
#include <cstring>

#include "burin/common/error.hpp"

namespace burin::compositor {

namespace {

constexpr std::uint32_t kMark = 0x4e525542;  // "BURN"

struct Header {
  std::uint32_t mark;
  std::int32_t x0, y0, x1, y1;
  std::uint32_t pixelBytes;
  std::uint64_t begin, end;
};
static_assert(sizeof(Header) == kShareHeaderBytes);

bool isInside(const PixelRect& rect, const PixelRect& bounds) {
  return rect.x0 >= bounds.x0 && rect.y0 >= bounds.y0 && rect.x1 <= bounds.x1 &&
         rect.y1 <= bounds.y1;
}

}  // namespace

void writeShareHeader(const ActiveArea& area, std::size_t pixelBytes,
                      std::span<std::byte, kShareHeaderBytes> out) {
  const PixelRect& rect = area.rect;
  const Header header{kMark,
                      rect.x0,
                      rect.y0,
                      rect.x1,
                      rect.y1,
                      static_cast<std::uint32_t>(pixelBytes),
                      area.region.begin,
                      area.region.end};
  std::memcpy(out.data(), &header, sizeof header);
}

ActiveArea readShareHeader(std::span<const std::byte> message, const PixelRect& bounds,
                           const Region& region, std::size_t pixelBytes) {
  if (message.size() < kShareHeaderBytes) {
    fail(ExitCode::kRank, "at least {} bytes expected, {} received", kShareHeaderBytes,
         message.size());
  }
  Header header;
  std::memcpy(&header, message.data(), sizeof header);
  if (header.mark != kMark) fail(ExitCode::kRank, "not a compositing message");
  if (header.pixelBytes != pixelBytes) {
    fail(ExitCode::kRank, "pixels of {} bytes expected, of {} received", pixelBytes,
         header.pixelBytes);
  }
  if (header.begin != region.begin || header.end != region.end) {
    fail(ExitCode::kRank, "region [{},{}) expected, [{},{}) received", region.begin, region.end,
         header.begin, header.end);
  }
  const PixelRect rect{header.x0, header.y0, header.x1, header.y1};
  if (!rect.empty() && !isInside(rect, bounds)) {
    fail(ExitCode::kRank, "active rectangle [{},{})x[{},{}) is out of bounds", rect.x0, rect.x1,
         rect.y0, rect.y1);
  }
  const ActiveArea area{bounds, region, rect};
  const std::size_t expected = shareBytes(area.pixels(), pixelBytes);
  if (message.size() != expected) {
    fail(ExitCode::kRank, "{} bytes expected, {} received", expected, message.size());
  }
  return area;
}

}  // namespace burin::compositor
