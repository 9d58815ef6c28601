#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "burin/host/annotate.hpp"
#include "burin/host/gradient_histogram.hpp"
#include "burin/host/text.hpp"

namespace burin::host {

namespace {

constexpr int kPlotFont = 16;
constexpr int kPlotTick = 6;     ///< pixels
constexpr int kPlotWidth = 768;  ///< about; a whole number of pixels for each column
constexpr int kRowPixels = 3;
constexpr Colour kPlotPaper{255, 255, 255};
constexpr Colour kPlotInk{32, 32, 32};

enum class TextSide { kCentred, kLeftOf };

/// The paper with its plot area, written and drawn on.
class PlotSheet {
 public:
  PlotSheet(int width, int height)
      : line_{textHeight(kPlotFont)},
        plot_{textMask("0.00", kPlotFont).width + 2 * kPlotTick, line_ + kPlotTick, width, height} {
    picture_.size = {plot_.x + width + 3 * kPlotFont, plot_.y + height + kPlotTick + 2 * line_};
    picture_.bytes.assign(3 * picture_.size.pixels(), kPlotPaper.r);
  }

  const PixelRectangle& plot() const { return plot_; }
  int line() const { return line_; }
  DisplayPicture take() { return std::move(picture_); }

  void ink(const InkMask& mask, int x, int y) { drawInk(picture_, mask, x, y, kPlotInk); }
  void bar(int x, int y, int width, int height) {
    InkMask mask{width, height};
    std::ranges::fill(mask.coverage, std::uint8_t{255});
    ink(mask, x, y);
  }
  /// A line of text whose top is at y, centred at x or ending there.
  void text(const std::string& words, int x, int y, TextSide side) {
    const InkMask mask = textMask(words, kPlotFont);
    ink(mask, side == TextSide::kCentred ? x - mask.width / 2 : x - mask.width, y);
  }

 private:
  int line_;
  PixelRectangle plot_;
  DisplayPicture picture_;
};

InkMask shadesOf(const GradientHistogram& histogram, int columnPixels) {
  const std::size_t columns = histogram.values.counts.size();
  const std::int64_t most = *std::ranges::max_element(histogram.counts);
  InkMask mask{static_cast<int>(columns) * columnPixels, kGradientRows * kRowPixels};
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x) {
      const int row = kGradientRows - 1 - y / kRowPixels;
      const std::int64_t count = histogram.at(row, static_cast<std::size_t>(x / columnPixels));
      const double shade =
          count > 0 ? std::log1p(static_cast<double>(count)) / std::log1p(static_cast<double>(most))
                    : 0;
      mask.at(x, y) = static_cast<std::uint8_t>(std::lround(255 * shade));
    }
  return mask;
}

void drawPlotAxes(PlotSheet& sheet, const GradientHistogram& histogram, int columnPixels) {
  const PixelRectangle& plot = sheet.plot();
  const int bottom = plot.y + plot.height;
  sheet.bar(plot.x - 1, plot.y, 1, plot.height + 1);
  sheet.bar(plot.x - 1, bottom, plot.width + 1, 1);
  for (const double m : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const int y = bottom - static_cast<int>(std::lround(m * plot.height));
    sheet.bar(plot.x - kPlotTick, y, kPlotTick, 1);
    sheet.text(fmt::format("{:g}", m), plot.x - kPlotTick - 2, y - sheet.line() / 2,
               TextSide::kLeftOf);
  }
  const Histogram& values = histogram.values;
  const double range = values.highest - values.lowest;
  const double step = range > 0 ? roundLength(range / 4) : 1;
  for (double i = std::ceil(values.lowest / step); i * step <= values.highest; ++i) {
    const double bins = (i * step - values.lowest) / values.binWidth;
    const int x = plot.x + static_cast<int>(std::lround(bins * columnPixels));
    sheet.bar(x, bottom, 1, kPlotTick);
    sheet.text(fmt::format("{:.6g}", i * step), x, bottom + kPlotTick, TextSide::kCentred);
  }
}

}  // namespace

DisplayPicture drawGradientHistogram(const GradientHistogram& histogram) {
  const auto columns = static_cast<int>(histogram.values.counts.size());
  const int columnPixels = std::max(1, kPlotWidth / columns);
  PlotSheet sheet{columns * columnPixels, kGradientRows * kRowPixels};
  const PixelRectangle& plot = sheet.plot();
  sheet.ink(shadesOf(histogram, columnPixels), plot.x, plot.y);
  drawPlotAxes(sheet, histogram, columnPixels);
  const int middle = plot.x + plot.width / 2;
  sheet.text(fmt::format("gradient magnitude, 1 is {:.4g} per world unit", histogram.scale), middle,
             0, TextSide::kCentred);
  sheet.text("value", middle, plot.y + plot.height + kPlotTick + sheet.line(), TextSide::kCentred);
  return sheet.take();
}

}  // namespace burin::host
