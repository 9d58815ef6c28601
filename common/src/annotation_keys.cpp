#include "annotation_keys.hpp"

namespace burin::scene_io {

namespace {

using A = Annotations;

constexpr double kSmallestFont = 6;
constexpr double kLargestFont = 200;

Codec<ScaleBar> scaleBarCodec() {
  using B = ScaleBar;
  return object<B>(
      {field("length", "World length; default a round number, about a fifth of the picture",
             &B::length, number(kPositive)),
       field("unit", "What the length is in; default mm for anatomical volumes", &B::unit,
             text())});
}

/// Something that is there or not; its entry is written only if it is.
Field<A> presence(std::string_view name, std::string_view help, bool A::*member) {
  return field<A, bool>(
      name, help, boolean(),
      [member](const A& a) { return a.*member ? std::optional{true} : std::nullopt; },
      [member](A& a, bool value) { a.*member = value; });
}

}  // namespace

Codec<Annotations> annotationsCodec() {
  return object<A>(
      {field("title", "A line of text", &A::title, text()),
       presence("orientation", "The world's axes as arrows", &A::hasOrientation),
       field("scale_bar", "A bar of a length that is written beside it", &A::scaleBar,
             scaleBarCodec()),
       presence("legend", "Colour and opacity by value, of each layer", &A::hasLegend),
       field("color", "Of words and lines (sRGB); default dark or light against the background",
             &A::colour, colour()),
       field<A, double>(
           "font_size", "Height of text in pixels; default by the size of the picture",
           number({.minimum = kSmallestFont, .maximum = kLargestFont}),
           [](const A& a) {
             return a.fontSize > 0 ? std::optional<double>{a.fontSize} : std::nullopt;
           },
           [](A& a, double value) { a.fontSize = static_cast<int>(value); })});
}

}  // namespace burin::scene_io
