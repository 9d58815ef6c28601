#include "program_generator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "burin/common/error.hpp"
#include "curve_code.hpp"
#include "operator_weights.hpp"
#include "widget_code.hpp"

namespace burin::node {
namespace {

std::string typeOf(const ParameterSpec& parameter) {
  struct {
    std::string operator()(double) const { return "float"; }
    std::string operator()(const Colour&) const { return "vec3"; }
    std::string operator()(const std::string&) const { return "int"; }
    std::string operator()(const Curve&) const { return "int"; }  // number of the curve
    std::string operator()(const ColourCurve&) const { return "int"; }
    std::string operator()(const glm::dvec3&) const { return ""; }  // read by the CPU alone
  } name;
  return std::visit(name, parameter.defaultValue);
}

bool usedAnywhere(const Scene& scene, std::string_view style) {
  return std::ranges::any_of(scene.layers,
                             [&](const Layer& layer) { return layer.style(style) != nullptr; });
}

bool positionNeeded(const Scene& scene) {
  return std::ranges::any_of(styleTable(), [&](const StyleSpec& style) {
    return style.needsPosition && usedAnywhere(scene, style.name);
  });
}

/// `struct tone_parameters {…};` and the constants of its words.
std::string declareStyle(const StyleSpec& style) {
  std::string text = fmt::format("struct {}_parameters {{\n", style.name);
  std::string words;
  for (const ParameterSpec& parameter : style.parameters) {
    if (typeOf(parameter).empty()) continue;
    text += fmt::format("  {} {};\n", typeOf(parameter), parameter.name);
    for (std::size_t i = 0; i < parameter.choices.size(); ++i)
      words += fmt::format("const int {}_{}_{} = {};\n", style.name, parameter.name,
                           parameter.choices[i], i);
  }
  return text + "};\n" + words;
}

/// The statements that fill `<style>_parameters p` for one layer, the uniforms they read, and what
/// copies those before the loop.
struct ParameterCode {
  std::string uniforms;
  std::string prepare;
  std::string statements;
};

/// Declares a uniform and the copy of it that the loop over samples reads (see `one` in
/// lattice.glsl); returns the copy's name. `prepare` gets the statement that copies.
std::string keepUniform(std::string_view type, const std::string& uniform,
                        std::string& declarations, std::string& prepare) {
  std::string kept = "kept_" + uniform;
  declarations += fmt::format("uniform {0} {1};\n{0} {2};\n", type, uniform, kept);
  prepare += fmt::format("  {} = one * {};\n", kept, uniform);
  return kept;
}

ParameterCode parameterCode(const StyleSettings& settings, const StyleSpec& style,
                            std::size_t layer, CurveCode& curves) {
  ParameterCode code;
  for (std::size_t i = 0; i < style.parameters.size(); ++i) {
    const ParameterSpec& parameter = style.parameters[i];
    if (typeOf(parameter).empty()) continue;
    std::string value = parameterUniform(layer, style.name, parameter.name);
    if (const auto* word = std::get_if<std::string>(&settings.values[i])) {
      value = fmt::format("{}_{}_{}", style.name, parameter.name, *word);
    } else if (const auto* curve = std::get_if<Curve>(&settings.values[i])) {
      value = std::to_string(curves.add(curveUniform(layer, style.name, parameter.name), *curve));
    } else if (const auto* colours = std::get_if<ColourCurve>(&settings.values[i])) {
      value = std::to_string(curves.add(curveUniform(layer, style.name, parameter.name), *colours));
    } else {
      value = keepUniform(typeOf(parameter), value, code.uniforms, code.prepare);
    }
    code.statements += fmt::format("    p.{} = {};\n", parameter.name, value);
  }
  return code;
}

/// Whether operators look at more than the six face neighbours.
bool needsNeighbourhood(const GradientOperatorSet& operators) {
  return !GradientOperatorSet{GradientOperator::kCentral}.contains(operators);
}

bool quantisesNormals(const Scene& scene) {
  return scene.quality.normals == Normals::kQuantised && gradientNeeded(scene);
}

std::string normalOrientation(const StyleSettings* gradient) {
  const std::string word = gradient == nullptr ? "outward" : gradient->word("normal");
  if (word == "inward") return "kNormalInward";
  return word == "facing" ? "kNormalFacing" : "kNormalOutward";
}

/// Of a gradient by that operator; what the generated code calls it.
std::string gradientName(GradientOperator which) {
  if (which == GradientOperator::kSobel) return "sobelGradient";
  return which == GradientOperator::kRegression ? "regressionGradient" : "centralGradient";
}

/// The matrix that makes a gradient of differences, as copied before the loop.
constexpr const char* kToGradient = "kept_differencesToGradient";

/// A loop over the voxels of a cell: `coordinate` is where one lies, `share` its weight.
std::string cornerLoop(std::string_view cell, const std::string& statements) {
  return fmt::format(
      "  Cell cell = {};\n  for (int corner = 0; corner < 8; ++corner) {{\n"
      "    vec3 coordinate = cornerCoordinate(cell, corner);\n"
      "    float share = cornerShare(cell, corner);\n{}  }}\n",
      cell, statements);
}

/// What the differences at `coordinate` are taken from, if from more than the six face neighbours.
std::string neighbourhoodCode(const GradientOperatorSet& operators) {
  return needsNeighbourhood(operators) ? "  Neighbourhood around = neighbourhoodAt(coordinate);\n"
                                       : "";
}

/// The gradient there by one of the operators.
std::string gradientExpression(GradientOperator which, const GradientOperatorSet& operators) {
  const OperatorWeights weights = operatorWeights(which);
  std::string differences = "volumeDifferences(coordinate)";
  if (needsNeighbourhood(operators))
    differences = which == GradientOperator::kCentral
                      ? "(around.facesValid * around.faces)"
                      : fmt::format("weighted(around, vec3({:.9g}, {:.9g}, {:.9g}))", weights.face,
                                    weights.edge, weights.corner);
  return fmt::format("{} * {}", kToGradient, differences);
}

/// Statements for the gradients of a scene and their magnitudes, each operator's once.
std::string gradientCode(const GradientOperatorSet& operators, Normals normals) {
  const char* const palette = normals == Normals::kQuantised ? "quantisedGradient" : "";
  std::string text = neighbourhoodCode(operators);
  for (const GradientOperator which : kAllGradientOperators)
    if (operators.contains(which))
      text += fmt::format("  vec3 {0} = {1}({2});\n  float {0}Magnitude = length({0});\n",
                          gradientName(which), palette, gradientExpression(which, operators));
  return text;
}

/// The same of gradients that are quantised at voxels and then filtered.
std::string filteredGradientCode(const GradientOperatorSet& operators) {
  std::string before, within, after;
  for (const GradientOperator which : kAllGradientOperators) {
    if (!operators.contains(which)) continue;
    const std::string name = gradientName(which);
    before += fmt::format("  vec3 {} = vec3(0.0);\n", name);
    within += fmt::format("    {} += share * quantisedGradient({});\n", name,
                          gradientExpression(which, operators));
    after += fmt::format("  float {0}Magnitude = length({0});\n", name);
  }
  return before + cornerLoop("cellAt(coordinate)", neighbourhoodCode(operators) + within) + after;
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

  std::string text() const { return curves_.text() + styleCode() + uniforms_ + functions(); }

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

  std::string styleCode() const {
    std::string text;
    if (positionNeeded(scene_)) text += "#include \"position.glsl\"\n";
    if (haloReach(scene_) > 0) text += "#include \"halo.glsl\"\n";
    for (const StyleSpec& style : styleTable()) {
      if (!style.hasSnippet || !usedAnywhere(scene_, style.name)) continue;
      text += declareStyle(style) + fmt::format("#include \"styles/{}.glsl\"\n", style.name);
    }
    return text;
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

std::string parameterUniform(std::size_t layer, std::string_view style,
                             std::string_view parameter) {
  return fmt::format("layer{}_{}_{}", layer, style, parameter);
}
std::string curveUniform(std::size_t layer, std::string_view style, std::string_view parameter) {
  return parameterUniform(layer, style, parameter) + "_curve";
}
std::string placeUniform(std::size_t layer, std::string_view style) {
  return parameterUniform(layer, style, "place");
}
std::string haloUniform(std::size_t layer) {
  return parameterUniform(layer, "halo", "neighbours");
}
std::string transferUniform(std::size_t function) {
  return fmt::format("transfer{}", function);
}
std::string extinctionUniform(std::size_t function) {
  return fmt::format("extinctions{}", function);
}
std::string transferScaleUniform(std::size_t function) {
  return fmt::format("transferScale{}", function);
}
std::string visibleBinsUniform(std::size_t function) {
  return fmt::format("visibleBins{}", function);
}
std::string isoColourUniform(std::size_t layer) {
  return fmt::format("isoColour{}", layer);
}
std::string isoLineOpacityUniform(std::size_t layer) {
  return fmt::format("isoLineOpacity{}", layer);
}
std::string magnitudeUniform(std::size_t layer) {
  return fmt::format("magnitude{}", layer);
}
std::string widgetsUniform(std::size_t layer) {
  return fmt::format("widgets{}", layer);
}
std::string maskUniform(std::size_t layer) {
  return fmt::format("mask{}", layer);
}

std::vector<ClipPlane> cappedPlanes(const Scene& scene) {
  const auto seesCuts = [](const StyleSettings& s) { return findStyle(s.name)->seesCuts; };
  const bool anySees = std::ranges::any_of(scene.layers, [&](const Layer& layer) {
    return std::ranges::any_of(layer.styles, seesCuts);
  });
  std::vector<ClipPlane> planes = clipPlanes(scene);
  std::erase_if(planes, [&](const ClipPlane& plane) { return !anySees || !plane.hasCap; });
  return planes;
}

bool isAdaptive(const Quality& quality) {
  return quality.maxError && quality.preintegrated;
}

namespace {

std::string defineClipPlanes(const Scene& scene) {
  const std::size_t planes = clipPlanes(scene).size();
  return planes > 0 ? fmt::format("#define CLIP_PLANES {}\n", planes) : "";
}

/// Everything before the main function.
std::string programHead(const Scene& scene, const ProgramOptions& options,
                        std::optional<LayerPass> pass) {
  std::string text = "#version 450 core\n";
  text += fmt::format("#define LIGHTS {}\n", scene.lights.size()) + defineClipPlanes(scene);
  const std::size_t caps = cappedPlanes(scene).size();
  if (caps > 0) text += fmt::format("#define CAPS {}\n", caps);
  if (options.invalidVoxels) text += "#define INVALID_VOXELS\n";
  if (options.countSamples) text += "#define COUNT_SAMPLES\n";
  if (options.severalBricks) text += "#define SEVERAL_BRICKS\n";
  if (haloReach(scene) > 0) text += "#define HALOS\n";
  if (labelsNeeded(scene)) text += "#define LABELS\n";
  if (isAdaptive(scene.quality)) text += "#define ADAPTIVE\n";
  const auto surfaces = std::ranges::count(scene.layers, LayerMode::kIso, &Layer::mode);
  if (surfaces > 0) text += fmt::format("#define SURFACES {}\n", surfaces);
  if (isAdaptive(scene.quality) && options.isSteep) text += "#define STEEP\n";
  if (scene.quality.preintegrated)
    text +=
        fmt::format("#define PREINTEGRATED\n#define LAYERS {}\n",
                    std::max(transferFunctions(scene).size(), std::size_t{1}));  // none: no array
  const bool palettesBefore = scene.quality.palettes == Palettes::kBefore;
  const bool atVoxels = palettesBefore || quantisesNormals(scene);
  if (atVoxels) text += "#define AT_VOXELS\n";
  if (palettesBefore) text += "#define PALETTES_BEFORE\n";
  for (const char* file : {"lattice.glsl", "ownership.glsl", "counters.glsl", "opacity.glsl",
                           "volume.glsl", "skip.glsl", "shading.glsl"})
    text += fmt::format("#include \"{}\"\n", file);
  if (atVoxels) text += "#include \"voxels.glsl\"\n";
  if (quantisesNormals(scene)) text += "#include \"direction_palette.glsl\"\n";
  if (palettesBefore) text += "#include \"palettes.glsl\"\n";
  if (caps > 0) text += "#include \"caps.glsl\"\n";
  if (laplacianNeeded(scene)) text += "#include \"laplacian.glsl\"\n";
  if (labelsNeeded(scene)) text += "#include \"labels.glsl\"\n";
  if (needsNeighbourhood(gradientOperatorsNeeded(scene)))
    text += "#include \"neighbourhood.glsl\"\n";
  if (scene.quality.preintegrated) text += "#include \"preintegration.glsl\"\n";
  if (hasWidgets(scene)) text += "#include \"widgets.glsl\"\n";
  text += LayerCode{scene, pass}.text();
  if (hasSurfaces(scene)) text += "#include \"exact.glsl\"\n#include \"surfaces.glsl\"\n";
  return text;
}

}  // namespace

ShaderSource generateRaycastProgram(const Scene& scene, const ProgramOptions& options) {
  return expandIncludes(programHead(scene, options, {}) + "#include \"raycast.glsl\"\n",
                        "raycast program");
}

ShaderSource generateProjectionProgram(const Scene& scene, const ProgramOptions& options) {
  BURIN_CHECK_EQ(scene.layers.size(), 1u);
  std::string text = "#version 450 core\n" + defineClipPlanes(scene);
  if (options.invalidVoxels) text += "#define INVALID_VOXELS\n";
  if (options.countSamples) text += "#define COUNT_SAMPLES\n";
  if (scene.layers.front().mode == LayerMode::kAverage) text += "#define MEAN\n";
  for (const char* file : {"lattice.glsl", "ownership.glsl", "counters.glsl", "volume.glsl",
                           "exact.glsl", "skip.glsl", "projection.glsl"})
    text += fmt::format("#include \"{}\"\n", file);
  return expandIncludes(text, "projection program");
}

ShaderSource generateSliceProgram(const Scene& scene, LayerPass pass, SliceTarget target,
                                  const ProgramOptions& options) {
  BURIN_CHECK_EQ(scene.layers.size(), 1u);
  std::string text = programHead(scene, options, pass);
  if (pass == LayerPass::kLines) text += "#define LINES_ONLY\n";
  if (target == SliceTarget::kLayerImage) text += "#define LAYER_IMAGE\n";
  return expandIncludes(text + "#include \"slice.glsl\"\n", "slice program");
}

ShaderSource generateResolveProgram(std::size_t layers) {
  return expandIncludes(fmt::format("#version 450 core\n#define LAYERS {}\n"
                                    "#include \"opacity.glsl\"\n#include \"resolve.glsl\"\n",
                                    layers),
                        "resolve program");
}

ShaderSource fullscreenVertexSource() {
  return expandIncludes("#version 450 core\n#include \"fullscreen.vert\"\n", "vertex program");
}

}  // namespace burin::node
