#include "layer_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "curve_code.hpp"
#include "gradient_code.hpp"
#include "program_needs.hpp"
#include "style_code.hpp"
#include "uniform_names.hpp"
#include "widget_code.hpp"

namespace burin::node {
namespace {

std::string normalOrientation(const StyleSettings* gradient) {
  const std::string word = gradient == nullptr ? "outward" : gradient->word("normal");
  if (word == "inward") return "kNormalInward";
  return word == "facing" ? "kNormalFacing" : "kNormalOutward";
}

/// Everything generated for the layers, in the order in which it must appear.
class LayerCode {
 public:
  /// All passes in one, or one of them.
  LayerCode(const Scene& scene, std::optional<LayerPass> pass)
      : scene_{scene},
        pass_{pass},
        gradients_{gradientOperatorsNeeded(scene)},
        palettesBefore_{scene.quality.palettes == Palettes::kBefore},
        hasCaps_{!cappedPlanes(scene).empty()},
        hasSurfaces_{hasSurfaces(scene)} {
    for (std::size_t i = 0; i < scene.layers.size(); ++i) add(i);
  }

  std::string text() const { return curves_.text() + styleCode(scene_) + uniforms_ + functions(); }

 private:
  /// Classes are numbered as transferFunctions() are: one for the layer, one for its lines if these
  /// have opacities of their own.
  void add(std::size_t i) {
    if (scene_.layers[i].mode == LayerMode::kIso) {
      addIsoSurface(i);
    } else {
      addMedium(i);
    }
  }

  /// Shaded as a sample whose extinction is an opacity.
  void addIsoSurface(std::size_t i) {
    const Layer& layer = scene_.layers[i];
    const std::string look = keepUniform("vec4", isoColourUniform(i), uniforms_, prepare_);
    const std::string lines = keepUniform("float", isoLineOpacityUniform(i), uniforms_, prepare_);
    body_ += fmt::format(
        "  if (surface == {0}) {{\n"
        "    Shading s = Shading({1}.rgb, {1}.a, vec3(0.0), 0.0, 1.0);\n",
        surfaces_++, look);
    if (gradientNeededBy(layer)) addSurface(i, layer, {});
    addStyles(i, layer, [](const StyleSpec&) { return true; });
    body_ += fmt::format(
        "    drawLines(s, {});\n    extinction = min(s.extinction, 1.0);\n"
        "    colour = extinction * s.colour;\n  }}\n",
        lines);
  }

  void addMedium(std::size_t i) {
    const Layer& layer = scene_.layers[i];
    const bool ownLines = !layer.lineOpacity.empty();
    const bool byGradient = layer.transferFunction.isTwoDimensional();
    const std::size_t number = byGradient ? addWidgetClass(i) : addClass();
    function_ = number;
    const std::size_t lines = ownLines ? addClass() : number;
    const std::string shown = ownLines ? fmt::format(" + extinction{}", lines) : "";
    if (!layer.labels.empty()) bindToLabels(i, number, lines);
    const std::string shows = fmt::format("extinction{}{} > 0.0", number, shown);
    const bool hasHalo = layer.style("halo") != nullptr;
    std::string condition = hasSurfaces_ ? "surface < 0" : "";
    if (!hasHalo) condition += (hasSurfaces_ ? " && " : "") + shows;
    body_ += condition.empty() ? "  {\n" : fmt::format("  if ({}) {{\n", condition);
    std::string magnitude;
    if (byGradient) {
      magnitude = magnitudeOf(i, layer);
      addWidgets(i, number, magnitude);
      if (!layer.labels.empty())
        body_ +=
            fmt::format("    extinction{} *= membership({});\n", number, "kept_" + maskUniform(i));
    }
    const std::string colour = byGradient ? "widgetColour" : colourOf(number, ownLines);
    const bool fromPalette = palettesBefore_ && gradientNeededBy(layer);
    if (fromPalette) addStylePalette(i, layer);
    const std::string plain = fmt::format("{}, extinction{}", colour, number);
    body_ += fmt::format("    Shading s = {};\n",
                         fromPalette ? fmt::format("styled({}, palette)", plain)
                                     : fmt::format("Shading({}, vec3(0.0), 0.0, 1.0)", plain));
    if (gradientNeededBy(layer) && !fromPalette) addSurface(i, layer, magnitude);
    addStyles(i, layer,
              [&](const StyleSpec& style) { return !fromPalette || !style.needsGradient; });
    addResult(lines, hasHalo ? fmt::format("if ({}) ", shows) : "");
    body_ += "  }\n";
  }

  /// Classes count as far as the sample belongs to the layer's mask.
  void bindToLabels(std::size_t layer, std::size_t number, std::size_t lines) {
    const std::string mask = keepUniform("float", maskUniform(layer), uniforms_, prepare_);
    std::string& code = palettesBefore_ ? finish_ : classify_;
    code += fmt::format("  float member{} = membership({});\n", layer, mask);
    for (std::size_t i = number; i <= lines; ++i)
      code += fmt::format("  extinction{} *= member{};\n", i, layer);
  }

  std::size_t addClass() {
    const std::size_t i = classes_++;
    uniforms_ += fmt::format("uniform sampler1DArray {0};\nuniform vec4 {1};\nvec4 scale{2};\n",
                             transferUniform(i), transferScaleUniform(i), i);
    prepare_ += fmt::format("  scale{} = one * {};\n", i, transferScaleUniform(i));
    uniforms_ += fmt::format("float extinction{};\n", i);  // of the segment classified last
    if (scene_.quality.preintegrated) {
      addSegmentClass(i);
    } else if (palettesBefore_) {
      addVoxelClasses(i);
    } else {
      addMiddleClass(i);
    }
    total_ += fmt::format("{}extinction{}", i == 0 ? "" : " + ", i);
    return i;
  }

  /// The class of the middle's value.
  void addMiddleClass(std::size_t i) {
    uniforms_ += fmt::format("vec4 class{};\n", i);
    const std::string bins = keepUniform("vec2", visibleBinsUniform(i), uniforms_, prepare_);
    classify_ += fmt::format(
        "  float x{0} = (middle - scale{0}.x) * scale{0}.y;\n"
        "  class{0} = texture({1}, vec2((x{0} + 0.5) * scale{0}.w, 0.0));\n"
        "  extinction{0} = x{0} > {2}.x && x{0} < {2}.y ? class{0}.a : 0.0;\n",
        i, transferUniform(i), bins);
  }

  /// The classes of the voxels around, filtered.
  void addVoxelClasses(std::size_t i) {
    uniforms_ += fmt::format("vec4 class{};\n", i);
    const std::string bins = keepUniform("vec2", visibleBinsUniform(i), uniforms_, prepare_);
    classify_ += fmt::format("    class{0} += share * paletteEntry({1}, scale{0}, {2}, voxel.x);\n",
                             i, transferUniform(i), bins);
    begin_ += fmt::format("  class{} = vec4(0.0);\n", i);
    finish_ += fmt::format("  class{0} *= whole;\n  extinction{0} = class{0}.a;\n", i);
  }

  /// Means over the values between the segment's ends.
  void addSegmentClass(std::size_t i) {
    uniforms_ +=
        fmt::format("uniform sampler1D {1};\nvec4 first{0}, end{0};\n", i, extinctionUniform(i));
    prepare_ += fmt::format(
        "  first{0} = texelFetch({1}, ivec2(0), 0);\n"
        "  end{0} = texelFetch({1}, ivec2(int(scale{0}.z), 0), 0);\n",
        i, transferUniform(i));
    ends_ += fmt::format("  side.layers[{0}] = classifyEnd({1}, {2}, scale{0}, side.value);\n", i,
                         transferUniform(i), extinctionUniform(i));
    classify_ += fmt::format(
        "  extinction{0} = meanExtinction(scale{0}, front.layers[{0}], back.layers[{0}]);\n", i);
    beyond_ += fmt::format(
        "{1}abs(meanExtinction(scale{0}, edge.layers[{0}], beyond.layers[{0}]) - "
        "edge.layers[{0}].extinction)",
        i, i == 0 ? "" : " + ");
  }

  /// The class of a layer by value and gradient: of its values alone it is known whether anything
  /// may show.
  std::size_t addWidgetClass(std::size_t layer) {
    const std::size_t i = classes_++;
    const TransferFunction& function = scene_.layers[layer].transferFunction;
    const std::string rows = widgetsUniform(layer);
    const std::size_t count = kRowsPerWidget * function.widgets.size();
    uniforms_ += fmt::format("uniform vec4 {0}[{1}];\nvec4 kept_{0}[{1}];\nfloat extinction{2};\n",
                             rows, count, i);
    prepare_ +=
        fmt::format("  for (int i = 0; i < {1}; ++i) kept_{0}[i] = one * {0}[i];\n", rows, count);
    const bool preintegrated = scene_.quality.preintegrated;
    if (!preintegrated) {
      uniforms_ += fmt::format("float value{};\n", i);  // of the segment classified last
      classify_ += fmt::format("  value{} = middle;\n", i);
    }
    classify_ +=
        fmt::format("  extinction{} = {};\n", i,
                    widgetsShow(function, "kept_" + rows, preintegrated ? "front.value" : "middle",
                                preintegrated ? "back.value" : "middle"));
    beyond_ += i == 0 ? "0.0" : " + 0.0";  // steep functions, as this is, do without
    total_ += fmt::format("{}extinction{}", i == 0 ? "" : " + ", i);
    return i;
  }

  /// The layer's extinction and colour, now that its gradient is known.
  void addWidgets(std::size_t layer, std::size_t number, const std::string& magnitude) {
    const bool preintegrated = scene_.quality.preintegrated;
    const std::string middle = fmt::format("value{}", number);
    body_ +=
        sumWidgets(scene_.layers[layer].transferFunction, "kept_" + widgetsUniform(layer),
                   preintegrated ? "front.value" : middle, preintegrated ? "back.value" : middle,
                   fmt::format("min({}, 1.0)", magnitude));
    body_ += fmt::format(
        "    extinction{} = widgetSum.a;\n"
        "    vec3 widgetColour = widgetSum.rgb * (1.0 / max(widgetSum.a, 1e-30));\n",
        number);
  }

  /// Of a segment. A mean weighted by the layer's extinction is nothing where only lines show, and
  /// little but rounding beside it.
  std::string colourOf(std::size_t i, bool ownLines) const {
    if (!scene_.quality.preintegrated) return fmt::format("class{}.rgb", i);
    if (ownLines)
      return fmt::format("middleColour({1}, scale{0}, front.layers[{0}], back.layers[{0}])", i,
                         transferUniform(i));
    return fmt::format(
        "meanColour({1}, scale{0}, first{0}, end{0}, front.layers[{0}], back.layers[{0}])", i,
        transferUniform(i));
  }

  static bool gradientNeededBy(const Layer& layer) {
    return std::ranges::any_of(layer.styles, [](const StyleSettings& s) {
      const StyleSpec* spec = findStyle(s.name);
      return spec->hasSnippet && spec->needsGradient;
    });
  }

  /// Expression of the gradient's magnitude over the layer's scale.
  std::string magnitudeOf(std::size_t i, const Layer& layer) {
    const std::string unit = keepUniform("float", magnitudeUniform(i), uniforms_, prepare_);
    return fmt::format("{}Magnitude * {}", gradientName(gradientOperator(layer)), unit);
  }

  /// `magnitude`: magnitudeOf() if that was asked for before, else empty.
  void addSurface(std::size_t i, const Layer& layer, std::string magnitude) {
    const std::string floor =
        keepUniform("float", parameterUniform(i, "gradient", "noise_floor"), uniforms_, prepare_);
    if (magnitude.empty()) magnitude = magnitudeOf(i, layer);
    body_ += fmt::format("    Surface g = surfaceOf({}, {}, {}, {}, toEye);\n",
                         gradientName(gradientOperator(layer)), magnitude, floor,
                         normalOrientation(layer.style("gradient")));
    if (hasCaps_)
      body_ += fmt::format("    Surface cut = cutSurface(g, cap, {});\n",
                           normalOrientation(layer.style("gradient")));
  }

  /// What the styles by gradient make of black and of white at the voxels around, filtered.
  void addStylePalette(std::size_t i, const Layer& layer) {
    body_ += "    StylePalette palette = noPalette();\n";
    const std::string before = std::exchange(body_, "");
    addSurface(i, layer, {});
    body_ += "    for (int grey = 0; grey < 2; ++grey) {\n    Shading s = unstyled(float(grey));\n";
    addStyles(i, layer, [](const StyleSpec& style) { return style.needsGradient; });
    body_ +=
        "    if (grey == 0) addShare(palette.black, share, s);\n"
        "    else addShare(palette.white, share, s);\n    }\n";
    body_ = before + cornerLoop("cellAt(coordinate)",
                                gradientCode(gradients_, scene_.quality.normals) + body_);
  }

  /// What a style is given beside the shading and its parameters.
  std::string_view looksAt(const StyleSpec& style) const {
    if (style.needsLaplacian) return "laplacian, ";
    if (!style.needsGradient) return "";
    return hasCaps_ && style.seesCuts ? "cut, " : "g, ";
  }

  /// Those that `isMeant`.
  template <typename IsMeant>
  void addStyles(std::size_t i, const Layer& layer, const IsMeant& isMeant) {
    for (const StyleSettings& settings : layer.styles) {
      const StyleSpec& style = *findStyle(settings.name);
      if (!style.hasSnippet || !isMeant(style)) continue;
      const ParameterCode code = parameterCode(settings, style, i, curves_);
      uniforms_ += code.uniforms;
      prepare_ += code.prepare;
      std::string more = style.needsPosition ? positionOf(i, style) + ", " : "";
      if (style.name == "halo") more = haloCast(i) + ", ";
      body_ += fmt::format("    {{\n    {0}_parameters p;\n{1}    apply_{0}(s, {2}{3}p);\n    }}\n",
                           style.name, code.statements, looksAt(style), more);
    }
  }

  /// The sample's position along the style's direction.
  std::string positionOf(std::size_t layer, const StyleSpec& style) {
    const std::string uniform = placeUniform(layer, style.name);
    uniforms_ += fmt::format("uniform vec4 {0};\nvec4 kept_{0};\n", uniform);
    prepare_ += fmt::format("  kept_{0} = one * overCoordinate({0});\n", uniform);
    return fmt::format("positionAt(kept_{}, coordinate)", uniform);
  }

  /// What the layer's halos are at the sample.
  std::string haloCast(std::size_t layer) {
    std::string bins = "kept_" + visibleBinsUniform(function_);
    if (scene_.quality.preintegrated)
      bins = keepUniform("vec2", visibleBinsUniform(function_), uniforms_, prepare_);
    const std::string neighbours = haloUniform(layer);
    uniforms_ += fmt::format("uniform HaloNeighbours {};\n", neighbours);
    return fmt::format("haloAt(coordinate, toEye, {}, {}, scale{}, {})", neighbours,
                       transferUniform(function_), function_, bins);
  }

  /// `i`: class of the lines; `where`: what they are drawn if.
  void addResult(std::size_t i, const std::string& where) {
    if (!pass_) {
      body_ += fmt::format(
          "    {}drawLines(s, extinction{});\n"
          "    colour += s.extinction * s.colour;\n    extinction += s.extinction;\n",
          where, i);
    } else if (*pass_ == LayerPass::kColour) {
      body_ += "    colour = s.colour;\n    extinction = s.extinction;\n";
    } else {
      uniforms_ += "float lineAmount;\n";  // of the segment shaded last
      body_ += fmt::format(
          "    lineAmount = amountOfLines(s);\n    colour = colourOfLines(s);\n"
          "    extinction = extinction{} * lineAmount;\n",
          i);
    }
  }

  /// changeBeyond(): how much the extinction's mean over the values between two differs from that
  /// at the first, over all layers; for the adaptive march alone. classify(): whether a segment
  /// shows anything in any layer; shade(): its colour and extinction after the styles, for a
  /// segment that was classified last.
  std::string functions() const {
    const bool preintegrated = scene_.quality.preintegrated;
    std::string text;
    std::string prepare = prepare_ + curves_.prepare();
    if (hasCaps_) prepare += "  prepareCaps();\n";
    if (!gradients_.empty()) keepUniform("mat3", "differencesToGradient", text, prepare);
    if (quantisesNormals(scene_)) prepare += "  prepareDirections();\n";
    if (labelsNeeded(scene_)) prepare += "  prepareLabels();\n";
    text += "void prepareLayers() {\n" + prepare + "}\n";
    if (preintegrated)
      text += "void classifySide(inout Side side) {\n" + ends_ + "}\n#include \"sides.glsl\"\n";
    if (palettesBefore_) {
      text += "bool classify(Cell around) {\n" + begin_ + "  float valid = 0.0;\n" +
              cornerLoop("around",
                         "    vec2 voxel = voxelLookUp(coordinate);\n    share *= voxel.y;\n"
                         "    valid += share;\n" +
                             classify_) +
              "  float whole = valid >= 0.5 ? 1.0 / valid : 0.0;\n" + finish_;
    } else {
      text += fmt::format("bool classify({}) {{\n",
                          preintegrated ? "Side front, Side back" : "float middle");
      text += classify_;
    }
    // Halos show where no transfer function does.
    text += haloReach(scene_) > 0
                ? "  return true;\n}\n"
                : "  return " + (total_.empty() ? "0.0" : total_) + " > 0.0;\n}\n";
    if (isAdaptive(scene_.quality))
      text += "float changeBeyond(Side edge, Side beyond) {\n  return " +
              (beyond_.empty() ? "0.0" : beyond_) + ";\n}\n";
    text += fmt::format(
        "void shade(vec3 coordinate, {}vec3 toEye, {}out vec3 colour, out float extinction) {{\n",
        preintegrated ? "Side front, Side back, " : "", hasSurfaces_ ? "int surface, " : "");
    if (!palettesBefore_)
      text += quantisesNormals(scene_) ? filteredGradientCode(gradients_)
                                       : gradientCode(gradients_, Normals::kExact);
    if (hasCaps_) text += "  vec4 cap = capAt(coordinate);\n";
    if (laplacianNeeded(scene_)) text += "  float laplacian = laplacianAt(coordinate);\n";
    text += "  colour = vec3(0.0);\n  extinction = 0.0;\n" + body_;
    if (!pass_) text += "  if (extinction > 0.0) colour *= 1.0 / extinction;\n";
    return text + "}\n";
  }

  const Scene& scene_;
  std::optional<LayerPass> pass_;
  GradientOperatorSet gradients_;
  bool palettesBefore_;
  bool hasCaps_;
  bool hasSurfaces_;
  CurveCode curves_;
  std::size_t classes_ = 0;
  std::size_t function_ = 0;  // the transfer function of the layer that is added
  std::size_t surfaces_ = 0;
  std::string uniforms_, prepare_, ends_, classify_, beyond_, total_, body_;
  std::string begin_, finish_;  // of classify(), around a loop over voxels
};

}  // namespace

std::string layerCode(const Scene& scene, std::optional<LayerPass> pass) {
  return LayerCode{scene, pass}.text();
}

}  // namespace burin::node
