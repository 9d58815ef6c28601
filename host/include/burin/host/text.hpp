#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "burin/common/colour.hpp"
#include "burin/host/picture.hpp"

namespace burin::host {

/// A rectangle of pixels [x, x + width) × [y, y + height), rows downwards.
struct PixelRectangle {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  friend bool operator==(const PixelRectangle&, const PixelRectangle&) = default;
};

/// Whether the two have a pixel in common.
bool overlap(const PixelRectangle& a, const PixelRectangle& b);

/// How much of each pixel of a rectangle is covered by ink, 255 wholly, rows top to bottom.
struct InkMask {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> coverage;

  InkMask() = default;
  InkMask(int maskWidth, int maskHeight);
  std::uint8_t& at(int x, int y);
  std::uint8_t at(int x, int y) const;
};

/// One line of text in DejaVu Sans, `fontSize` pixels high; the mask has the height of a line
/// whatever the letters. Throws Error{kUsage} naming the Debian package if the font is not there.
InkMask textMask(const std::string& text, int fontSize);

/// Throws Error{kUsage} as textMask does, before anything is drawn that would be lost.
void checkFont();

/// Height of a line's mask.
int textHeight(int fontSize);

/// Covers the picture's pixels with ink of that colour, the mask's first one at (x, y); what lies
/// outside the picture is left out. Blends codes, as text is drawn on screens; straight alpha.
void drawInk(DisplayPicture& picture, const InkMask& mask, int x, int y, const Colour& colour);

}  // namespace burin::host
