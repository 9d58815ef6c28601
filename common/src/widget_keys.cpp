#include "widget_keys.hpp"

#include <array>
#include <utility>

#include "burin/common/scene.hpp"

namespace burin::scene_io {

namespace {

constexpr std::array<std::pair<WidgetShape, std::string_view>, 3> kShapeNames{
    {{WidgetShape::kTriangle, "triangle"},
     {WidgetShape::kRectangle, "rectangle"},
     {WidgetShape::kEllipse, "ellipse"}}};

Codec<WidgetShape> shapeCodec() {
  std::vector<std::string_view> names;
  for (const auto& [shape, name] : kShapeNames) names.push_back(name);
  const Codec<std::string> text = word(std::move(names));
  return {[text](const At& at) {
            const std::string written = text.read(at);
            for (const auto& [shape, name] : kShapeNames)
              if (name == written) return shape;
            at.fail("'{}' is unknown", written);
          },
          [](const WidgetShape& value) {
            return Document(kShapeNames[static_cast<std::size_t>(value)].second);
          },
          text.schema};
}

void checkWidget(const At& at, const TransferWidget& widget) {
  if (widget.shape != WidgetShape::kTriangle) forbid(at, "apex", "only a triangle has an apex");
  if (widget.shape == WidgetShape::kEllipse) {
    for (const char* key : {"value_falloff", "gradient_falloff"})
      forbid(at, key, "an ellipse falls off from its middle: only other shapes have this");
  } else if (widget.gradient.x < 0 || widget.gradient.y > 1) {
    forbid(at, "gradient", "expected numbers in [0, 1]; only an ellipse may reach beyond");
  }
}

}  // namespace

Codec<std::vector<TransferWidget>> widgetsCodec() {
  using W = TransferWidget;
  constexpr Range kFalloff{.minimum = kSmallestFalloff, .maximum = 1};
  const auto widget = object<W>(
      {required(field("shape",
                      "triangle (from its apex at gradient 0 to the values at its upper gradient), "
                      "rectangle, or ellipse",
                      &W::shape, shapeCodec())),
       required(
           field("value", "First and last value in data units", &W::value, risingPair(kAnyNumber))),
       field("gradient",
             "First and last gradient magnitude, over the layer's scale (style gradient). A "
             "rectangle's edge at 0 and one at 1 are none: what lies beyond belongs to it",
             &W::gradient, risingPair({.minimum = -1, .maximum = 2})),
       field("apex", "Value of a triangle's apex; default the middle of its values", &W::apex,
             number(kAnyNumber)),
       field(
           "value_falloff",
           "Share of half the width over which extinction falls to 0 at either edge; default 1 of "
           "triangles, 0.25 of rectangles",
           &W::valueFalloff, number(kFalloff)),
       field("gradient_falloff", "The same of half the height; default 0.25", &W::gradientFalloff,
             number(kFalloff)),
       required(field("color", "Colour (sRGB)", &W::colour, colour())),
       required(field("opacity", "Largest opacity in it, per opacity unit length", &W::opacity,
                      number({.minimum = 0, .maximum = 1})))},
      checkWidget);
  return list(widget, 1, static_cast<std::size_t>(kMostListed));
}

}  // namespace burin::scene_io
