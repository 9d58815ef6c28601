#include "layer_keys.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "burin/common/labels.hpp"
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

constexpr std::array kModes{LayerMode::kDvr, LayerMode::kIso, LayerMode::kMip, LayerMode::kAverage};

Codec<std::string> modeWord() {
  std::vector<std::string_view> names;
  for (const LayerMode mode : kModes) names.emplace_back(burin::name(mode));
  return word(std::move(names));
}

/// `value`: one of modeWord().
LayerMode modeNamed(std::string_view value) {
  return *std::find_if(kModes.begin(), kModes.end(),
                       [&](LayerMode mode) { return burin::name(mode) == value; });
}

/// A projection has no place on its ray, so nothing of what styles go by.
void checkProjection(const At& at, const Layer& layer) {
  const char* key = layer.styles.empty() ? "line_opacity" : "style";
  const Node* found = at.node.find(key);
  if (found == nullptr || (layer.styles.empty() && layer.lineOpacity.empty())) return;
  At::failAt(found->where, json::childPath(at.path, key),
             fmt::format("a layer of mode \"{}\" has no place that styles could see; expected mode "
                         "\"dvr\" or \"iso\"",
                         burin::name(layer.mode)));
}

/// What goes by value alone knows no regions of value and gradient.
void checkTwoDimensional(const At& at, const Layer& layer) {
  if (layer.mode != LayerMode::kDvr)
    at.fail("mode \"{}\" is by value alone: expected a transfer function of 'points', or \"dvr\"",
            burin::name(layer.mode));
  if (layer.style("halo") != nullptr)
    at.fail("'halo' finds features by value alone: expected a transfer function of 'points'");
  if (!layer.lineOpacity.empty())
    at.fail("'line_opacity' is by value alone: beside 'widgets' lines have the opacity of these");
}

/// Labels say where there is a medium.
void checkLabels(const At& at, const Layer& layer) {
  if (layer.mode != LayerMode::kDvr)
    at.fail("'labels' bind a medium: expected \"mode\": \"dvr\", found \"{}\"",
            burin::name(layer.mode));
  if (layer.style("halo") != nullptr)
    at.fail("'halo' lies around a medium, where 'labels' have none: expected one of the two");
}

void checkLayer(const At& at, const Layer& layer) {
  if (!layer.labels.empty()) checkLabels(at, layer);
  if (layer.transferFunction.isTwoDimensional()) checkTwoDimensional(at, layer);
  if (isProjection(layer.mode)) checkProjection(at, layer);
  const bool isSurface = layer.mode == LayerMode::kIso;
  if (isSurface && !layer.isoValue) at.fail("'iso_value' is missing beside \"mode\": \"iso\"");
  if (isSurface && layer.style("halo") != nullptr)
    at.fail("'halo' lies around a medium: expected \"mode\": \"dvr\"");
  for (const char* key : {"iso_value", "iso_opacity"}) {
    const Node* found = at.node.find(key);
    if (found != nullptr && !isSurface)
      At::failAt(found->where, json::childPath(at.path, key),
                 fmt::format("a layer of mode \"{}\" is no surface; expected \"mode\": \"iso\"",
                             burin::name(layer.mode)));
  }
}

constexpr std::size_t kMostLabels = 4096;

/// A label's number or name.
Codec<LabelName> labelNameCodec() {
  const Codec<int> number = wholeNumber({.minimum = -kLargestLabel, .maximum = kLargestLabel});
  const Codec<std::string> name = text();
  return {[number, name](const At& at) {
            if (at.node.kind == Node::Kind::kText) return LabelName{name.read(at)};
            return LabelName{number.read(at)};
          },
          [number, name](const LabelName& label) {
            const int* value = std::get_if<int>(&label);
            return value != nullptr ? number.write(*value)
                                    : name.write(std::get<std::string>(label));
          },
          Document{{"anyOf", {number.schema, name.schema}}}};
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
       field<L, std::vector<LabelName>>(
           "labels",
           "The layer is only where the label volume has one of these numbers or names; default "
           "everywhere",
           list(labelNameCodec(), 1, kMostLabels),
           [](const L& l) { return l.labels.empty() ? std::nullopt : std::optional{l.labels}; },
           [](L& l, std::vector<LabelName> labels) { l.labels = std::move(labels); }),
       field("style",
             "Effects on this layer, an empty entry with its defaults; or the name of "
             "a style",
             &L::styles, styleOrNameCodec()),
       field<L, std::string>(
           "mode",
           "dvr: a medium with the transfer function's opacities; iso: the surface where the "
           "volume "
           "is iso_value, in the transfer function's colour there; mip, average: colour and "
           "opacity "
           "of the largest value on a ray, or of their mean, over the layers before",
           modeWord(), [](const L& l) { return std::optional<std::string>{burin::name(l.mode)}; },
           [](L& l, const std::string& value) { l.mode = modeNamed(value); }),
       field("iso_value", "Value of the surface, in data units", &L::isoValue, number(kAnyNumber)),
       field<L, double>(
           "iso_opacity", "Opacity of the surface wherever a ray meets it; default 1",
           number({.minimum = 0, .maximum = 1}),
           [](const L& l) {
             return l.mode == LayerMode::kIso ? std::optional{l.isoOpacity} : std::nullopt;
           },
           [](L& l, double value) { l.isoOpacity = value; })},
      checkLayer);
}

}  // namespace burin::scene_io
