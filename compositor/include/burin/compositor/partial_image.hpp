#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "burin/compositor/active_area.hpp"
#include "burin/compositor/message_buffer.hpp"
#include "burin/compositor/pixel_algebra.hpp"
#include "burin/compositor/share_header.hpp"
#include "burin/compositor/subimage.hpp"

namespace burin::compositor {

/// Pixel number `index` of the pixels in a message.
template <PixelAlgebra A>
typename A::Pixel loadPixel(std::span<const std::byte> pixels, std::size_t index) {
  return A::load(pixels.subspan(index * A::kWireBytes).template first<A::kWireBytes>());
}

/// One participant's pixels while the frame is composited: those of an active rectangle in the
/// region it still holds. Everything else of the region is the identity, and is neither stored nor
/// sent nor visited.
template <PixelAlgebra A>
class PartialImage {
 public:
  using Pixel = typename A::Pixel;

  PartialImage() = default;
  /// `image.active` lies inside `bounds`. Holds all of the bounds.
  PartialImage(const PixelRect& bounds, Subimage<Pixel> image)
      : area_{bounds, {0, bounds.pixels()}, image.active}, pixels_{std::move(image.pixels)} {}

  const ActiveArea& area() const { return area_; }
  std::span<const Pixel> pixels() const {
    return std::span{pixels_}.subspan(first_, area_.pixels());
  }

  /// The message that carries the pixels of `region`, which is held.
  MessageBuffer encode(const Region& region) const {
    const ActiveArea sent = area_.within(region);
    MessageBuffer message{shareBytes(sent.pixels(), A::kWireBytes)};
    writeShareHeader(sent, A::kWireBytes, message.bytes().template first<kShareHeaderBytes>());
    auto out = message.bytes().subspan(kShareHeaderBytes);
    for (const Pixel& pixel : pixels().subspan(area_.pixelsBefore(region.begin), sent.pixels())) {
      A::store(pixel, out.template first<A::kWireBytes>());
      out = out.subspan(A::kWireBytes);
    }
    return message;
  }

  /// Gives up everything outside `region`, which is held. Moves no pixel.
  void narrow(const Region& region) {
    first_ += area_.pixelsBefore(region.begin);
    area_ = area_.within(region);
  }

  /// Combines a message for the held region with the pixels here. Throws Error{kRank}, changing
  /// nothing, if the message is damaged.
  void combine(std::span<const std::byte> message, bool messageIsInFront) {
    const ActiveArea incoming = readShareHeader(message, area_.bounds, area_.region, A::kWireBytes);
    if (incoming.pixels() == 0) return;
    growTo(boundingRect(area_.rect, incoming.rect));
    const auto received = message.subspan(kShareHeaderBytes);
    if (messageIsInFront) {
      merge(incoming, received,
            [](const Pixel& mine, const Pixel& theirs) { return A::combine(theirs, mine); });
    } else {
      merge(incoming, received,
            [](const Pixel& mine, const Pixel& theirs) { return A::combine(mine, theirs); });
    }
  }

  /// Writes the active pixels to their places in a frame.
  void pasteInto(Image<Pixel>& frame) const {
    forEachRow(area_, [&](int y, RowSpan span, std::size_t first) {
      std::ranges::copy(pixels().subspan(first, span.pixels()), &frame.at(span.x0, y));
    });
  }

 private:
  /// Makes `rect`, which contains the present one, the active rectangle; new pixels are identities.
  void growTo(const PixelRect& rect) {
    if (rect == area_.rect) return;
    const ActiveArea grown{area_.bounds, area_.region, rect};
    std::vector<Pixel> out(grown.pixels(), A::identity());
    std::size_t begin = 0;  // of the row in `out`; grown has every row that area_ has
    for (int y = rect.y0; y < rect.y1; ++y) {
      const RowSpan to = grown.row(y);
      const RowSpan from = area_.row(y);
      if (from.pixels() > 0) {
        const std::size_t source = area_.pixelsBefore(numberOf(from.x0, y));
        std::ranges::copy(pixels().subspan(source, from.pixels()),
                          out.begin() + static_cast<std::ptrdiff_t>(begin) + (from.x0 - to.x0));
      }
      begin += to.pixels();
    }
    pixels_ = std::move(out);
    first_ = 0;
    area_ = grown;
  }

  template <typename Combine>
  void merge(const ActiveArea& incoming, std::span<const std::byte> received, Combine combinePair) {
    forEachRow(incoming, [&](int y, RowSpan span, std::size_t first) {
      const std::size_t mine = first_ + area_.pixelsBefore(numberOf(span.x0, y));
      for (std::size_t i = 0; i < span.pixels(); ++i) {
        Pixel& pixel = pixels_[mine + i];
        pixel = combinePair(pixel, loadPixel<A>(received, first + i));
      }
    });
  }

  std::size_t numberOf(int x, int y) const {
    const PixelRect& b = area_.bounds;
    return static_cast<std::size_t>(y - b.y0) * static_cast<std::size_t>(b.width()) +
           static_cast<std::size_t>(x - b.x0);
  }

  ActiveArea area_;
  std::vector<Pixel> pixels_;
  std::size_t first_ = 0;  ///< place of the first pixel still held
};

/// Writes a message's pixels to their places in a frame. Throws Error{kRank} if it is damaged.
template <PixelAlgebra A>
void pasteMessage(std::span<const std::byte> message, const PixelRect& bounds, const Region& region,
                  Image<typename A::Pixel>& frame) {
  const ActiveArea area = readShareHeader(message, bounds, region, A::kWireBytes);
  const auto received = message.subspan(kShareHeaderBytes);
  forEachRow(area, [&](int y, RowSpan span, std::size_t first) {
    const auto row = frame.row(y).subspan(static_cast<std::size_t>(span.x0), span.pixels());
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = loadPixel<A>(received, first + i);
  });
}

}  // namespace burin::compositor
