#include "style_code.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "uniform_names.hpp"

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

}  // namespace

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

std::string styleCode(const Scene& scene) {
  std::string text;
  if (positionNeeded(scene)) text += "#include \"position.glsl\"\n";
  if (haloReach(scene) > 0) text += "#include \"halo.glsl\"\n";
  for (const StyleSpec& style : styleTable()) {
    if (!style.hasSnippet || !usedAnywhere(scene, style.name)) continue;
    text += declareStyle(style) + fmt::format("#include \"styles/{}.glsl\"\n", style.name);
  }
  return text;
}

std::string keepUniform(std::string_view type, const std::string& uniform,
                        std::string& declarations, std::string& prepare) {
  std::string kept = "kept_" + uniform;
  declarations += fmt::format("uniform {0} {1};\n{0} {2};\n", type, uniform, kept);
  prepare += fmt::format("  {} = one * {};\n", kept, uniform);
  return kept;
}

}  // namespace burin::node
