#include "widget_code.hpp"

#include <fmt/format.h>

namespace burin::node {
namespace {

/// An edge at m = 0 or 1 that is none: the part stays 1 wherever m may be.
constexpr glm::dvec2 kOpenBelow{-1, 1};
constexpr glm::dvec2 kOpenAbove{2, 1};
constexpr double kNever = -1e30;  ///< below all stored values

/// Rows 1 and 2 of a triangle or rectangle; its values from `first` on.
void addTrapezoid(const TransferWidget& widget, double first, const ValueScale& scale,
                  std::vector<glm::vec4>& rows) {
  // Straight lines: what they are at m = 0 and 1 says all.
  const glm::dvec2 atZero = widget.edgesAt(0);
  const glm::dvec2 rise = (widget.edgesAt(1) - atZero) / scale.range;
  rows.emplace_back(glm::vec4{glm::dvec4{(atZero.x - first) / scale.range, rise.x,
                                         (atZero.y - first) / scale.range, rise.y}});
  const glm::dvec2& m = widget.gradient;
  const double perMagnitude = 2 / (widget.gradientFalloffUsed() * (m.y - m.x));
  const bool isClosedBelow = widget.shape == WidgetShape::kTriangle || m.x > 0;
  const glm::dvec2 lower = isClosedBelow ? glm::dvec2{m.x, perMagnitude} : kOpenBelow;
  const glm::dvec2 upper = m.y < 1 ? glm::dvec2{m.y, perMagnitude} : kOpenAbove;
  rows.emplace_back(glm::vec4{glm::dvec4{lower, upper}});
}

void addEllipse(const TransferWidget& widget, const ValueScale& scale,
                std::vector<glm::vec4>& rows) {
  const glm::dvec2& v = widget.value;
  const glm::dvec2& m = widget.gradient;
  rows.emplace_back(glm::vec4{
      glm::dvec4{0, scale.range / (v.y / 2 - v.x / 2), (m.x + m.y) / 2, 2 / (m.y - m.x)}});
  rows.emplace_back(glm::vec4{0});
}

}  // namespace

std::vector<glm::vec4> widgetRows(const TransferFunction& function, const ValueScale& scale) {
  std::vector<glm::vec4> rows;
  for (const TransferWidget& widget : function.widgets) {
    const glm::dvec2 range = widget.valueRange();
    const double falloff = widget.valueFalloffUsed();
    // One of opacity 0 shows no values, as the envelope has it.
    const double last = widget.opacity > 0 ? scale.stored(range.y) : kNever;
    rows.emplace_back(glm::vec4{glm::dvec4{scale.stored(range.x), last, 1 / falloff, 1 - falloff}});
    if (widget.shape == WidgetShape::kEllipse)
      addEllipse(widget, scale, rows);
    else
      addTrapezoid(widget, range.x, scale, rows);
    const double extinction =
        extinctionFromOpacity(widget.opacity, function.opacityUnitLength.value());
    rows.emplace_back(glm::vec4{glm::dvec4{widget.colour.linear(), extinction}});
  }
  return rows;
}

std::string widgetsShow(const TransferFunction& function, const std::string& rows,
                        const std::string& front, const std::string& back) {
  std::string shows = "0.0";
  for (std::size_t i = 0; i < function.widgets.size(); ++i)
    shows = fmt::format("max({}, widgetShows({}[{}], {}, {}))", shows, rows, kRowsPerWidget * i,
                        front, back);
  return shows;
}

std::string sumWidgets(const TransferFunction& function, const std::string& rows,
                       const std::string& front, const std::string& back,
                       const std::string& magnitude) {
  std::string text = "    vec4 widgetSum = vec4(0.0);\n";
  for (std::size_t i = 0; i < function.widgets.size(); ++i) {
    const auto row = [&](std::size_t number) {
      return fmt::format("{}[{}]", rows, kRowsPerWidget * i + number);
    };
    const bool isEllipse = function.widgets[i].shape == WidgetShape::kEllipse;
    const std::string part = isEllipse
                                 ? fmt::format("ellipseMean({}, {}", row(0), row(1))
                                 : fmt::format("trapezoidMean({}, {}, {}", row(0), row(1), row(2));
    text += fmt::format("    addWidget(widgetSum, {}, {}, {}, {}, {}));\n", row(3), part, front,
                        back, magnitude);
  }
  return text;
}

}  // namespace burin::node
