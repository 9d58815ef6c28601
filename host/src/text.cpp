#include "burin/host/text.hpp"

#include <algorithm>
#include <cmath>

#include "burin/common/error.hpp"
#include "picture_module.hpp"
#include "text_renderer.hpp"

namespace burin::host {

namespace {

constexpr const char* kFont = "DejaVuSans";

/// Lines of the font reach this far above and below the base line, of its size.
constexpr double kAscent = 0.93;
constexpr double kDescent = 0.28;

int ascent(int fontSize) {
  return static_cast<int>(std::ceil(kAscent * fontSize));
}

/// `over` by coverage c in [0, 1], of straight colours: the new alpha and the ink's share of the
/// colour.
struct Blend {
  double alpha;
  double inkShare;
};

Blend blend(double coverage, double alphaBelow) {
  const double alpha = coverage + (1 - coverage) * alphaBelow;
  return {alpha, alpha > 0 ? coverage / alpha : 0};
}

std::uint8_t mixed(std::uint8_t below, std::uint8_t ink, double inkShare) {
  return static_cast<std::uint8_t>(std::lround(below + inkShare * (ink - below)));
}

}  // namespace

bool overlap(const PixelRectangle& a, const PixelRectangle& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

InkMask::InkMask(int maskWidth, int maskHeight)
    : width{maskWidth},
      height{maskHeight},
      coverage(static_cast<std::size_t>(maskWidth) * static_cast<std::size_t>(maskHeight)) {}

std::uint8_t& InkMask::at(int x, int y) {
  return coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
}

std::uint8_t InkMask::at(int x, int y) const {
  return const_cast<InkMask&>(*this).at(x, y);
}

int textHeight(int fontSize) {
  return ascent(fontSize) + static_cast<int>(std::ceil(kDescent * fontSize));
}

namespace {

RenderedText rendered(const std::string& text, int fontSize) {
  static auto* const render = reinterpret_cast<RenderText*>(pictureFunction(kRenderText));
  RenderedText result;
  render({text, kFont, fontSize, ascent(fontSize), textHeight(fontSize)}, result);
  if (!result.hasFont) {
    fail(ExitCode::kUsage, "the font {} for labels is not found (Debian package fonts-dejavu-core)",
         kFont);
  }
  if (!result.error.empty())
    fail(ExitCode::kRank, "drawing the text \"{}\": {}", text, result.error);
  return result;
}

}  // namespace

void checkFont() {
  constexpr int kAnySize = 12;
  rendered("x", kAnySize);
}

InkMask textMask(const std::string& text, int fontSize) {
  RenderedText result = rendered(text, fontSize);
  InkMask mask{result.width, textHeight(fontSize)};
  mask.coverage = std::move(result.coverage);
  return mask;
}

void drawInk(DisplayPicture& picture, const InkMask& mask, int x, int y, const Colour& colour) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  const std::uint8_t ink[] = {colour.r, colour.g, colour.b};
  for (int row = std::max(0, -y); row < std::min(mask.height, picture.size.height - y); ++row) {
    for (int column = std::max(0, -x); column < std::min(mask.width, picture.size.width - x);
         ++column) {
      const std::uint8_t covered = mask.at(column, row);
      if (covered == 0) continue;
      const std::size_t pixel =
          static_cast<std::size_t>(y + row) * static_cast<std::size_t>(picture.size.width) +
          static_cast<std::size_t>(x + column);
      std::uint8_t* below = picture.bytes.data() + pixel * channels;
      const Blend result = blend(covered / 255.0, channels == 4 ? below[3] / 255.0 : 1);
      for (std::size_t channel = 0; channel < 3; ++channel)
        below[channel] = mixed(below[channel], ink[channel], result.inkShare);
      if (channels == 4) below[3] = static_cast<std::uint8_t>(std::lround(255 * result.alpha));
    }
  }
}

}  // namespace burin::host
