#include "contact_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "burin/common/error.hpp"
#include "burin/common/scene.hpp"

namespace burin::host {

namespace {

constexpr int kGap = 4;  // pixels around every panel
constexpr int kSmallestFont = 9;
constexpr int kLargestFont = 28;
constexpr int kFontsPerPanel = 15;

constexpr Colour kPaper{255, 255, 255};
constexpr Colour kInk{32, 32, 32};

/// What of the mask is in its first `width` columns.
InkMask leftPart(const InkMask& mask, int width) {
  InkMask part{std::min(mask.width, width), mask.height};
  for (int row = 0; row < part.height; ++row)
    for (int column = 0; column < part.width; ++column) part.at(column, row) = mask.at(column, row);
  return part;
}

}  // namespace

int squareColumns(int count) {
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))));
}

SheetLayout layOutSheet(ImageSize panel, int count, int columns, int labelLines) {
  SheetLayout layout;
  layout.panel = panel;
  layout.labelLines = labelLines;
  layout.columns = std::min(columns, count);
  layout.fontSize = std::clamp(panel.width / kFontsPerPanel, kSmallestFont, kLargestFont);
  layout.lineHeight = textMask("x", layout.fontSize).height;
  layout.labelHeight = labelLines * layout.lineHeight;
  const int rows = (count + layout.columns - 1) / layout.columns;
  const long long width = kGap + static_cast<long long>(layout.columns) * (panel.width + kGap);
  const long long height =
      kGap + static_cast<long long>(rows) * (panel.height + layout.labelHeight + kGap);
  if (std::max(width, height) > kLargestImageSide) {
    fail(ExitCode::kUsage, "a sheet of {} x {} pixels, expected at most {} on a side", width,
         height, kLargestImageSide);
  }
  layout.size = {static_cast<int>(width), static_cast<int>(height)};
  return layout;
}

ContactSheet::ContactSheet(const SheetLayout& layout) : layout_{layout} {
  sheet_.size = layout.size;
  sheet_.channels = 3;
  sheet_.bytes.assign(3 * sheet_.size.pixels(), kPaper.r);
}

void ContactSheet::place(int index, const DisplayPicture& picture, const std::string& label) {
  const ImageSize panel = layout_.panel;
  BURIN_CHECK(picture.size == panel && picture.channels == 3);
  const int x = kGap + index % layout_.columns * (panel.width + kGap);
  const int y = kGap + index / layout_.columns * (panel.height + layout_.labelHeight + kGap);
  const auto rowBytes = 3 * static_cast<std::ptrdiff_t>(panel.width);
  for (int row = 0; row < panel.height; ++row) {
    const auto from = picture.bytes.begin() + row * rowBytes;
    const auto to = 3 * ((y + row) * static_cast<std::ptrdiff_t>(sheet_.size.width) + x);
    std::copy(from, from + rowBytes, sheet_.bytes.begin() + to);
  }
  int below = y + layout_.panel.height;
  for (const InkMask& line : lines(label)) {
    drawInk(sheet_, line, x + (layout_.panel.width - line.width) / 2, below, kInk);
    below += layout_.lineHeight;
  }
}

std::vector<InkMask> ContactSheet::lines(const std::string& label) const {
  std::vector<std::string> texts;
  std::istringstream words{label};
  for (std::string word; words >> word;) {
    const std::string longer = texts.empty() ? word : texts.back() + " " + word;
    if (!texts.empty() && textMask(longer, layout_.fontSize).width <= layout_.panel.width) {
      texts.back() = longer;
    } else if (static_cast<int>(texts.size()) < layout_.labelLines) {
      texts.push_back(word);
    } else {
      texts.back() = longer;  // cut off
      break;
    }
  }
  std::vector<InkMask> masks;
  for (const std::string& text : texts)
    masks.push_back(leftPart(textMask(text, layout_.fontSize), layout_.panel.width));
  return masks;
}

}  // namespace burin::host
