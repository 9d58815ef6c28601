#include "contact_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "burin/common/error.hpp"
#include "burin/common/scene.hpp"
#include "burin/host/text.hpp"

namespace burin::host {

namespace {

constexpr int kGap = 4;  // pixels around every panel
constexpr int kSmallestFont = 9;
constexpr int kLargestFont = 28;
constexpr int kFontsPerPanel = 15;

constexpr Colour kPaper{255, 255, 255};
constexpr Colour kInk{32, 32, 32};

}  // namespace

int squareColumns(int count) {
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count)))));
}

ContactSheet::ContactSheet(ImageSize panel, int count, int columns)
    : panel_{panel},
      columns_{std::min(columns, count)},
      fontSize_{std::clamp(panel.width / kFontsPerPanel, kSmallestFont, kLargestFont)},
      labelHeight_{textMask("x", fontSize_).height} {
  const int rows = (count + columns_ - 1) / columns_;
  const long long width = kGap + static_cast<long long>(columns_) * (panel.width + kGap);
  const long long height =
      kGap + static_cast<long long>(rows) * (panel.height + labelHeight_ + kGap);
  if (std::max(width, height) > kLargestImageSide) {
    fail(ExitCode::kUsage, "a sheet of {} x {} pixels, expected at most {} on a side", width,
         height, kLargestImageSide);
  }
  sheet_.size = {static_cast<int>(width), static_cast<int>(height)};
  sheet_.channels = 3;
  sheet_.bytes.assign(3 * sheet_.size.pixels(), kPaper.r);
}

void ContactSheet::place(int index, const DisplayPicture& picture, const std::string& label) {
  BURIN_CHECK(picture.size == panel_ && picture.channels == 3);
  const int x = kGap + index % columns_ * (panel_.width + kGap);
  const int y = kGap + index / columns_ * (panel_.height + labelHeight_ + kGap);
  const auto rowBytes = 3 * static_cast<std::ptrdiff_t>(panel_.width);
  for (int row = 0; row < panel_.height; ++row) {
    const auto from = picture.bytes.begin() + row * rowBytes;
    const auto to = 3 * ((y + row) * static_cast<std::ptrdiff_t>(sheet_.size.width) + x);
    std::copy(from, from + rowBytes, sheet_.bytes.begin() + to);
  }
  InkMask text = textMask(label, fontSize_);
  InkMask shown{std::min(text.width, panel_.width), text.height};
  for (int row = 0; row < shown.height; ++row)
    for (int column = 0; column < shown.width; ++column)
      shown.at(column, row) = text.at(column, row);
  drawInk(sheet_, shown, x + (panel_.width - shown.width) / 2, y + panel_.height, kInk);
}

}  // namespace burin::host
