#include "layer_keys.hpp"

#include <algorithm>
#include <limits>

#include "transfer_function_file.hpp"
#include "widget_keys.hpp"

namespace burin::scene_io {

namespace {

Codec<TransferPoint> pointCodec() {
  using P = TransferPoint;
  return object<P>({required(field("value", "Value in data units", &P::value, number(kAnyNumber))),
                    required(field("color", "Colour there (sRGB)", &P::colour, colour())),
                    required(field("opacity", "Opacity there, per opacity unit length", &P::opacity,
                                   number({.minimum = 0, .maximum = 1})))});
}

/// `at`: the list of the points.
template <typename Point>
void checkPoints(const At& at, const std::vector<Point>& points) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const At point = at.item(i);
    if (points[i].value < points[i - 1].value) {
      point.fail("value {} is below {} of the point before; expected rising values",
                 points[i].value, points[i - 1].value);
    }
    if (i >= 2 && points[i].value == points[i - 2].value) {
      point.fail("third point at value {}; two make a step", points[i].value);
    }
  }
}

constexpr std::size_t kMostPoints = 4096;

Codec<std::vector<OpacityPoint>> lineOpacityCodec() {
  using P = OpacityPoint;
  auto codec = list(
      object<P>({required(field("value", "Value in data units", &P::value, number(kAnyNumber))),
                 required(field("opacity", "Opacity there, per opacity unit length", &P::opacity,
                                number({.minimum = 0, .maximum = 1})))}),
      1, kMostPoints);
  codec.read = [read = codec.read](const At& at) {
    std::vector<P> points = read(at);
    checkPoints(at, points);
    return points;
  };
  return codec;
}

Codec<StyleSettings> settingsCodec(const StyleSpec& spec) {
  using S = StyleSettings;
  Fields<S> fields;
  for (std::size_t i = 0; i < spec.parameters.size(); ++i) {
    const ParameterSpec& p = spec.parameters[i];
    const std::string help =
        p.unit.empty() ? std::string{p.help} : fmt::format("{}; {}", p.help, p.unit);
    fields.push_back(field<S, ParameterValue>(
        p.name, help, parameter(p), [i](const S& s) { return std::optional{s.values[i]}; },
        [i](S& s, ParameterValue value) { s.values[i] = std::move(value); }));
  }
  return object<S>(std::move(fields), {}, defaultSettings(spec));
}

/// "transfer_function", as people may write it; a file is gone before it is read.
Codec<TransferFunction> transferFunctionOrFileCodec() {
  auto codec = transferFunctionCodec();
  codec.schema = Document{{"anyOf", {std::move(codec.schema), colourMapChoiceSchema()}}};
  return codec;
}

/// "style", as people may write it; a name and a base are gone before it is read.
Codec<std::vector<StyleSettings>> styleOrNameCodec() {
  auto codec = stylesCodec();
  addKeySchema(codec.schema, "base", "A named style that the entries beside it change", false,
               text().schema, std::nullopt);
  addKeySchema(codec.schema, "without", "Entries of the base that are left out", false,
               listSchema(1, styleTable().size(), text().schema), std::nullopt);
  Document name{{"type", "string"}, {"description", "A named style (burin styles), or its file"}};
  codec.schema = Document{{"anyOf", {std::move(name), std::move(codec.schema)}}};
  return codec;
}

}  // namespace

Codec<TransferFunction> transferFunctionCodec() {
  using F = TransferFunction;
  return object<F>(
      {field<F, std::vector<TransferPoint>>(
           "points", "Points by rising value, linear between them; two at one value make a step",
           list(pointCodec(), 1, kMostPoints),
           [](const F& f) { return f.points.empty() ? std::nullopt : std::optional{f.points}; },
           [](F& f, std::vector<TransferPoint> points) { f.points = std::move(points); }),
       field<F, std::vector<TransferWidget>>(
           "widgets", "Instead of points: regions of value and gradient magnitude", widgetsCodec(),
           [](const F& f) { return f.widgets.empty() ? std::nullopt : std::optional{f.widgets}; },
           [](F& f, std::vector<TransferWidget> widgets) { f.widgets = std::move(widgets); }),
       field("opacity_unit_length",
             "World length that opacities refer to; default the smallest voxel spacing",
             &F::opacityUnitLength, number(kPositive))},
      [](const At& at, const F& function) {
        if (function.points.empty() == function.widgets.empty())
          at.fail("expected exactly one of 'points' and 'widgets'");
        if (!function.points.empty())
          checkPoints({*at.node.find("points"), json::childPath(at.path, "points")},
                      function.points);
      });
}

Codec<std::vector<StyleSettings>> stylesCodec() {
  using Styles = std::vector<StyleSettings>;
  Fields<Styles> fields;  // in the table's order, which sorts the settings
  for (const StyleSpec& spec : styleTable()) {
    fields.push_back(field<Styles, StyleSettings>(
        spec.name, spec.help, settingsCodec(spec),
        [name = spec.name](const Styles& styles) {
          const auto found = std::find_if(styles.begin(), styles.end(),
                                          [&](const StyleSettings& s) { return s.name == name; });
          return found == styles.end() ? std::nullopt : std::optional{*found};
        },
        [](Styles& styles, StyleSettings value) { styles.push_back(std::move(value)); }));
  }
  return object<Styles>(std::move(fields));
}

Codec<Layer> layerCodec() {
  using L = Layer;
  return object<L>(
      {field("name", "Name for people", &L::name, text()),
       required(field("transfer_function",
                      "Colour and opacity by value: points, or a file of another program; or by "
                      "value and gradient magnitude: widgets",
                      &L::transferFunction, transferFunctionOrFileCodec())),
       field<L, std::vector<OpacityPoint>>(
           "line_opacity", "Opacity of the lines by value, in place of the transfer function's",
           lineOpacityCodec(),
           [](const L& l) {
             return l.lineOpacity.empty() ? std::nullopt : std::optional{l.lineOpacity};
           },
           [](L& l, std::vector<OpacityPoint> points) { l.lineOpacity = std::move(points); }),
       field("style",
             "Effects on this layer, an empty entry with its defaults; or the name of "
             "a style",
             &L::styles, styleOrNameCodec())},
      [](const At& at, const L& layer) {
        if (layer.transferFunction.isTwoDimensional() && layer.style("halo") != nullptr)
          at.fail("'halo' finds features by value alone: expected a transfer function of 'points'");
        if (layer.transferFunction.isTwoDimensional() && !layer.lineOpacity.empty())
          at.fail(
              "'line_opacity' is by value alone: beside 'widgets' lines have the opacity of "
              "these");
      });
}

}  // namespace burin::scene_io
