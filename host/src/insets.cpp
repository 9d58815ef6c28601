#include "insets.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "burin/common/error.hpp"
#include "burin/host/annotate.hpp"
#include "burin/host/text.hpp"

namespace burin::host {

namespace {

DisplayPicture emptyInset(int width, int height) {
  DisplayPicture inset;
  inset.size = {width, height};
  inset.channels = 4;
  inset.bytes.resize(4 * inset.size.pixels());
  return inset;
}

std::uint8_t coverageOf(double covered) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(covered, 0.0, 1.0)));
}

/// A line with round ends, from and to in pixels (centres at half numbers), smooth at its sides.
void addLine(InkMask& mask, const glm::dvec2& from, const glm::dvec2& to, double thickness) {
  const glm::dvec2 along = to - from;
  const double length2 = std::max(glm::dot(along, along), 1e-12);
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) {
      const glm::dvec2 offset = glm::dvec2{x + 0.5, y + 0.5} - from;
      const double t = std::clamp(glm::dot(offset, along) / length2, 0.0, 1.0);
      const double distance = glm::length(offset - t * along);
      mask.at(x, y) = std::max(mask.at(x, y), coverageOf(0.5 + thickness / 2 - distance));
    }
  }
}

void addBox(InkMask& mask, const PixelRectangle& box) {
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x) mask.at(x, y) = 255;
}

Colour displayed(const glm::dvec3& linear) {
  const auto code = [](double value) {
    return coverageOf(srgbFromLinear(std::clamp(value, 0.0, 1.0)));
  };
  return {code(linear.r), code(linear.g), code(linear.b)};
}

struct Arrow {
  std::string name;
  Colour colour;
  glm::dvec3 axis;
};

void drawArrow(DisplayPicture& inset, const Arrow& arrow, const Camera& camera, int fontSize) {
  constexpr double kHead = 0.25;  // of the arrow's length
  const glm::dvec2 centre = glm::dvec2{inset.size.width, inset.size.height} / 2.0;
  const double reach = centre.x - 1.1 * fontSize;
  const glm::dvec2 direction = directionOnScreen(arrow.axis, camera);
  const glm::dvec2 tip = centre + reach * direction;
  const double thickness = std::max(1.5, fontSize / 8.0);
  InkMask lines{inset.size.width, inset.size.height};
  addLine(lines, centre, tip, thickness);
  const glm::dvec2 side = kHead * reach * glm::dvec2{-direction.y, direction.x};
  const glm::dvec2 neck = tip - kHead * reach * direction;
  addLine(lines, tip, neck + 0.5 * side, thickness);
  addLine(lines, tip, neck - 0.5 * side, thickness);
  drawInk(inset, lines, 0, 0, arrow.colour);
  const InkMask name = textMask(arrow.name, fontSize);
  const double size = glm::length(direction);
  const glm::dvec2 outward = size > 0 ? direction / size : glm::dvec2{0, 0};
  const glm::dvec2 at = tip + 0.6 * fontSize * outward - glm::dvec2{name.width, name.height} / 2.0;
  drawInk(inset, name, static_cast<int>(std::lround(at.x)), static_cast<int>(std::lround(at.y)),
          arrow.colour);
}

/// The values that a legend shows: from the first to the last point, or a unit around one alone;
/// those of all widgets.
struct ShownRange {
  double lowest;
  double highest;
};

ShownRange valuesOfWidgets(const TransferFunction& function) {
  const glm::dvec2 first = function.widgets.front().valueRange();
  ShownRange range{first.x, first.y};
  for (const TransferWidget& widget : function.widgets) {
    const glm::dvec2 own = widget.valueRange();
    range = {std::min(range.lowest, own.x), std::max(range.highest, own.y)};
  }
  return range;
}

ShownRange shownValues(const TransferFunction& function) {
  if (function.isTwoDimensional()) return valuesOfWidgets(function);
  const double lowest = function.points.front().value;
  const double highest = function.points.back().value;
  if (highest > lowest) return {lowest, highest};
  return {lowest - 0.5, lowest + 0.5};
}

/// Opacity as height, filled with colour, and the colour alone in a strip below.
void drawFunction(DisplayPicture& inset, const TransferFunction& function,
                  const PixelRectangle& area, int stripHeight) {
  const ShownRange range = shownValues(function);
  const double unit = function.opacityUnitLength.value_or(1);
  for (int column = 0; column < area.width; ++column) {
    const double t = (column + 0.5) / area.width;
    const Classified found = function.classify((1 - t) * range.lowest + t * range.highest, unit);
    const double opacity = -std::expm1(-found.extinction * unit);
    InkMask mask{1, area.height};
    for (int row = 0; row < area.height; ++row) {
      const int fromBelow = area.height - 1 - row;
      mask.at(0, row) =
          fromBelow < stripHeight
              ? 255
              : coverageOf(opacity * (area.height - stripHeight) - (fromBelow - stripHeight));
    }
    drawInk(inset, mask, area.x + column, area.y, displayed(found.colour));
  }
}

/// Gradient magnitude as height, colour covering as much as it is opaque.
void drawWidgets(DisplayPicture& inset, const TransferFunction& function,
                 const PixelRectangle& area, const Colour& ink) {
  const ShownRange range = shownValues(function);
  const double unit = function.opacityUnitLength.value_or(1);
  InkMask dot{1, 1};
  for (int row = 0; row < area.height; ++row) {
    const double magnitude = 1 - (row + 0.5) / area.height;
    for (int column = 0; column < area.width; ++column) {
      const double t = (column + 0.5) / area.width;
      const Classified found =
          function.classify((1 - t) * range.lowest + t * range.highest, magnitude, unit);
      dot.at(0, 0) = coverageOf(-std::expm1(-found.extinction * unit));
      drawInk(inset, dot, area.x + column, area.y + row, displayed(found.colour));
    }
  }
  InkMask axes{area.width, area.height};
  addBox(axes, {0, 0, 1, area.height});
  addBox(axes, {0, area.height - 1, area.width, 1});
  drawInk(inset, axes, area.x, area.y, ink);
}

std::string shortNumber(double value) {
  return fmt::format("{:.4g}", value);
}

}  // namespace

DisplayPicture titleInset(const std::string& title, int fontSize, const Colour& ink) {
  const InkMask text = textMask(title, fontSize);
  DisplayPicture inset = emptyInset(text.width, text.height);
  drawInk(inset, text, 0, 0, ink);
  return inset;
}

DisplayPicture scaleBarInset(double pixels, const std::string& label, int fontSize,
                             const Colour& ink) {
  const InkMask text = textMask(label, fontSize);
  const int length = std::max(1, static_cast<int>(std::lround(pixels)));
  const int thickness = std::max(2, fontSize / 6);
  const int tick = 3 * thickness;
  DisplayPicture inset = emptyInset(std::max(length, text.width), tick + text.height);
  InkMask bar{length, tick};
  addBox(bar, {0, thickness, length, thickness});
  addBox(bar, {0, 0, std::min(thickness, length), tick});
  addBox(bar, {std::max(0, length - thickness), 0, std::min(thickness, length), tick});
  drawInk(inset, bar, (inset.size.width - length) / 2, 0, ink);
  drawInk(inset, text, (inset.size.width - text.width) / 2, tick, ink);
  return inset;
}

DisplayPicture orientationInset(const Camera& camera, bool isAnatomical, int fontSize,
                                const Colour& ink) {
  const int side = 6 * fontSize;
  DisplayPicture inset = emptyInset(side, side);
  const auto tinted = [&](const Colour& pure) {
    return displayed(0.75 * pure.linear() + 0.25 * ink.linear());
  };
  std::array<Arrow, 3> arrows{Arrow{isAnatomical ? "L" : "X", tinted({220, 40, 40}), {1, 0, 0}},
                              Arrow{isAnatomical ? "P" : "Y", tinted({30, 150, 30}), {0, 1, 0}},
                              Arrow{isAnatomical ? "S" : "Z", tinted({50, 80, 230}), {0, 0, 1}}};
  std::ranges::sort(arrows, std::greater{},
                    [&](const Arrow& arrow) { return glm::dot(arrow.axis, camera.forward); });
  for (const Arrow& arrow : arrows) drawArrow(inset, arrow, camera, fontSize);
  return inset;
}

DisplayPicture legendInset(const std::vector<Layer>& layers, int fontSize, const Colour& ink) {
  const int width = 10 * fontSize;
  const int plot = 3 * fontSize;
  const int strip = std::max(2, fontSize / 3);
  const int line = textHeight(fontSize);
  const int perLayer = line + plot + line + fontSize / 2;
  DisplayPicture inset = emptyInset(width, perLayer * static_cast<int>(layers.size()));
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const TransferFunction& function = layers[i].transferFunction;
    const int top = perLayer * static_cast<int>(i);
    drawInk(inset, textMask(layers[i].name, fontSize), 0, top, ink);
    const PixelRectangle area{0, top + line, width, plot};
    if (function.isTwoDimensional())
      drawWidgets(inset, function, area, ink);
    else
      drawFunction(inset, function, area, strip);
    const ShownRange range = shownValues(function);
    drawInk(inset, textMask(shortNumber(range.lowest), fontSize), 0, top + line + plot, ink);
    const InkMask highest = textMask(shortNumber(range.highest), fontSize);
    drawInk(inset, highest, width - highest.width, top + line + plot, ink);
  }
  return inset;
}

}  // namespace burin::host
