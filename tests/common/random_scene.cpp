#include "random_scene.hpp"

#include <algorithm>
#include <cmath>

namespace burin::test {

namespace {

class Maker {
 public:
  explicit Maker(std::mt19937& random) : random_{random} {}

  Scene scene() {
    Scene s;
    if (chance()) s.volume = volume();
    if (chance()) s.labels = {volume(), chance() ? text() : ""};
    s.camera = camera();
    s.imageSize = {whole(1, 16384), whole(1, 16384)};
    s.background = chance() ? std::optional{colour()} : std::nullopt;
    s.lights = several<Light>(1, [&] { return Light{vector(), chance(), colour(), real(0, 100)}; });
    s.layers = several<Layer>(1, [&] { return layer(); });
    s.clip = several<ClipPlane>(0, [&] { return ClipPlane{vector(), any(), chance()}; });
    if (chance()) s.clipBox = clipBox();
    if (chance())
      s.quality = quality();
    else
      s.quality.maxError = hasProjections(s) ? std::nullopt : std::optional{real(1e-4, 0.5)};
    if (chance()) s.annotations = annotations();
    return s;
  }

 private:
  bool chance() { return whole(0, 1) == 1; }
  int whole(int lo, int hi) { return std::uniform_int_distribution<int>{lo, hi}(random_); }
  double real(double lo, double hi) {
    // Now and then a round number, which people write and which must not lose its type.
    const double x = std::uniform_real_distribution<double>{lo, hi}(random_);
    return chance() ? x : std::clamp(std::round(x), lo, hi);
  }
  Quality quality() {
    Quality q{real(kSmallestStepVoxels, 100), real(0, 0.5), chance(), std::nullopt,
              chance() ? Combine::kSum : Combine::kOver};
    q.normals = chance() ? Normals::kExact : Normals::kQuantised;
    if (!q.preintegrated && chance()) q.palettes = Palettes::kBefore;
    return q;
  }
  /// Any magnitude that a double has.
  double any() { return std::ldexp(real(-1, 1), whole(-1070, 1020)); }
  double positive() { return std::ldexp(real(0.5, 1), whole(-1000, 1020)); }
  ClipBox clipBox() {
    const glm::dvec3 a = vector(), b = vector();
    return {glm::min(a, b), glm::max(a, b) + glm::dvec3{glm::equal(a, b)}, chance()};
  }
  glm::dvec3 vector() { return {any(), any(), positive()}; }
  Colour colour() {
    const auto channel = [&] { return static_cast<std::uint8_t>(whole(0, 255)); };
    return {channel(), channel(), channel()};
  }
  std::string text() {
    static const std::vector<std::string> kTexts{"a",        "bone", "häåd \"1\"",
                                                 "C:\\x\ty", "脑",   "a/b.nrrd"};
    return pick(kTexts);
  }
  template <typename T>
  T pick(const std::vector<T>& values) {
    return values[static_cast<std::size_t>(whole(0, static_cast<int>(values.size()) - 1))];
  }
  template <typename T, typename Make>
  std::vector<T> several(int least, Make make) {
    std::vector<T> all(static_cast<std::size_t>(whole(least, 4)));
    for (T& one : all) one = make();
    return all;
  }
  template <typename T>
  std::optional<T> maybe(T value) {
    return chance() ? std::optional{std::move(value)} : std::nullopt;
  }

  VolumeChoice volume() {
    VolumeChoice v;
    const glm::ivec3 dims{whole(1, 2000), whole(1, 2000), whole(1, 2000)};
    if (chance()) {
      v.file = text();
      v.dims = maybe(dims);
      v.endian = maybe(pick<std::string>({"little", "big"}));
    } else {
      v.procedural = text();
      v.dims = dims;
    }
    v.type = maybe(pick<std::string>({"u8", "i16", "u16", "f32"}));
    v.spacing = maybe(glm::dvec3{positive(), positive(), positive()});
    return v;
  }

  CameraChoice camera() {
    CameraChoice c;
    c.verticalFovDeg = real(0.001, 179.9);
    c.zoom = positive();
    c.projection = chance() ? Projection::kPerspective : Projection::kOrthographic;
    const std::string axis = pick<std::string>({"auto", "y", "z"});
    switch (whole(0, 2)) {
      case 0:
        c.azimuthDeg = any();
        c.elevationDeg = real(-180, 180);
        c.upAxis = axis;
        break;
      case 1:
        c.view =
            pick<std::string>({"anterior", "posterior", "left", "right", "superior", "inferior"});
        break;
      default:
        c.eye = vector();
        c.target = maybe(glm::dvec3{any(), any(), -1.0});
        c.upVector = maybe(vector());
        if (!c.upVector) c.upAxis = axis;
    }
    return c;
  }

  Annotations annotations() {
    Annotations made;
    made.title = maybe(text());
    made.hasOrientation = chance();
    if (chance()) made.scaleBar = ScaleBar{maybe(positive()), maybe(text())};
    made.hasLegend = chance();
    made.colour = maybe(colour());
    made.fontSize = chance() ? whole(6, 200) : 0;
    return made;
  }

  Layer layer() {
    Layer made;
    made.name = chance() ? text() : "";
    const auto count = static_cast<std::size_t>(whole(1, 6));
    std::vector<double> values(count);
    for (double& v : values) v = any();
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    for (const double value : values) {
      made.transferFunction.points.push_back({value, colour(), real(0, 1)});
    }
    if (chance()) made.transferFunction.points.push_back({values.back(), colour(), 1});
    made.transferFunction.opacityUnitLength = maybe(positive());
    if (whole(0, 3) == 0) {
      made.transferFunction.points.clear();
      made.transferFunction.widgets = several<TransferWidget>(1, [&] { return widget(); });
    } else if (chance())
      for (const double value : values) made.lineOpacity.push_back({value, real(0, 1)});
    if (!made.transferFunction.isTwoDimensional())
      made.mode =
          pick<LayerMode>({LayerMode::kDvr, LayerMode::kIso, LayerMode::kMip, LayerMode::kAverage});
    if (made.mode == LayerMode::kDvr && chance())
      for (int i = whole(0, 3); i >= 0; --i)
        made.labels.push_back(chance() ? LabelName{whole(-70000, 70000)} : LabelName{text()});
    const bool mayHaveHalos = made.mode == LayerMode::kDvr && made.labels.empty() &&
                              !made.transferFunction.isTwoDimensional();
    for (const StyleSpec& spec : styleTable()) {
      if (spec.name == "halo" && !mayHaveHalos) continue;
      if (chance()) made.styles.push_back(settings(spec));
    }
    if (made.mode == LayerMode::kIso) {
      made.isoValue = any();
      made.isoOpacity = real(0, 1);
    }
    if (isProjection(made.mode)) {
      made.styles.clear();
      made.lineOpacity.clear();
    }
    return made;
  }

  TransferWidget widget() {
    TransferWidget made;
    const double first = any();
    made.value = {first, std::nextafter(first, 2 * std::abs(first) + 1) + positive()};
    made.shape =
        pick<WidgetShape>({WidgetShape::kTriangle, WidgetShape::kRectangle, WidgetShape::kEllipse});
    const bool isEllipse = made.shape == WidgetShape::kEllipse;
    made.gradient = {real(isEllipse ? -1 : 0, 0.4), real(0.5, isEllipse ? 2 : 1)};
    if (made.shape == WidgetShape::kTriangle) made.apex = maybe(any());
    if (!isEllipse) made.valueFalloff = maybe(real(kSmallestFalloff, 1));
    if (!isEllipse) made.gradientFalloff = maybe(real(kSmallestFalloff, 1));
    made.colour = colour();
    made.opacity = real(0, 1);
    return made;
  }

  StyleSettings settings(const StyleSpec& spec) {
    StyleSettings made = defaultSettings(spec);
    for (std::size_t i = 0; i < made.values.size(); ++i) {
      const ParameterSpec& p = spec.parameters[i];
      ParameterValue& value = made.values[i];
      if (std::holds_alternative<double>(value)) {
        value = real(p.minimum, p.maximum);
      } else if (std::holds_alternative<Colour>(value)) {
        value = colour();
      } else if (std::holds_alternative<std::string>(value)) {
        value = std::string{pick(p.choices)};
      } else if (std::holds_alternative<glm::dvec3>(value)) {
        value = vector();
      } else if (std::holds_alternative<ColourCurve>(value)) {
        value = curve<ColourCurve>([&] { return colour(); });
      } else {
        value = curve<Curve>([&] { return real(p.minimum, p.maximum); });
      }
    }
    return made;
  }

  template <typename AnyCurve, typename Make>
  AnyCurve curve(Make y) {
    AnyCurve made;
    for (int x = whole(-2, 0); x < 2; ++x) made.points.push_back({x + real(0, 0.9), y()});
    return made;
  }

  std::mt19937& random_;
};

}  // namespace

Scene randomScene(std::mt19937& random) {
  return Maker{random}.scene();
}

}  // namespace burin::test
