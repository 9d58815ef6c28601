#include "program_generator.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace burin::node {
namespace {

std::string typeOf(const ParameterSpec& parameter) {
  struct {
    std::string operator()(double) const { return "float"; }
    std::string operator()(const Colour&) const { return "vec3"; }
    std::string operator()(const std::string&) const { return "int"; }
    std::string operator()(const Curve&) const { return "int"; }  // number of the curve
  } name;
  return std::visit(name, parameter.defaultValue);
}

bool usedAnywhere(const Scene& scene, std::string_view style) {
  return std::ranges::any_of(scene.layers,
                             [&](const Layer& layer) { return layer.style(style) != nullptr; });
}

/// `struct tone_parameters {…};` and the constants of its words.
std::string declareStyle(const StyleSpec& style) {
  std::string text = fmt::format("struct {}_parameters {{\n", style.name);
  std::string words;
  for (const ParameterSpec& parameter : style.parameters) {
    text += fmt::format("  {} {};\n", typeOf(parameter), parameter.name);
    for (std::size_t i = 0; i < parameter.choices.size(); ++i)
      words += fmt::format("const int {}_{}_{} = {};\n", style.name, parameter.name,
                           parameter.choices[i], i);
  }
  return text + "};\n" + words;
}

/// Numbers the curves of a scene and writes the function that evaluates them: a sum of clamped
/// ramps, exact at any resolution. curve[0] is (start value, -, -), the others (x, length, slope).
class CurveSet {
 public:
  int add(const std::string& uniform, const Curve& curve) {
    const int number = count_++;
    declarations_ += fmt::format("uniform vec3 {}[{}];\n", uniform, curve.points.size());
    cases_ += fmt::format("  if (number == {}) {{\n    y = {}[0].x;\n", number, uniform);
    for (std::size_t i = 1; i < curve.points.size(); ++i)
      cases_ += fmt::format("    y += {0}[{1}].z * clamp(x - {0}[{1}].x, 0.0, {0}[{1}].y);\n",
                            uniform, i);
    cases_ += "  }\n";
    return number;
  }
  std::string text() const {
    if (count_ == 0) return "";
    return declarations_ + "float evaluateCurve(int number, float x) {\n  float y = 0.0;\n" +
           cases_ + "  return y;\n}\n";
  }

 private:
  int count_ = 0;
  std::string declarations_;
  std::string cases_;
};

/// The statements that fill `<style>_parameters p` for one layer, and the uniforms they read.
struct ParameterCode {
  std::string uniforms;
  std::string statements;
};

ParameterCode parameterCode(const StyleSettings& settings, const StyleSpec& style,
                            std::size_t layer, CurveSet& curves) {
  ParameterCode code;
  for (std::size_t i = 0; i < style.parameters.size(); ++i) {
    const ParameterSpec& parameter = style.parameters[i];
    std::string value = parameterUniform(layer, style.name, parameter.name);
    if (const auto* word = std::get_if<std::string>(&settings.values[i])) {
      value = fmt::format("{}_{}_{}", style.name, parameter.name, *word);
    } else if (const auto* curve = std::get_if<Curve>(&settings.values[i])) {
      value =
          fmt::format("{}", curves.add(curveUniform(layer, style.name, parameter.name), *curve));
    } else {
      code.uniforms += fmt::format("uniform {} {};\n", typeOf(parameter), value);
    }
    code.statements += fmt::format("    p.{} = {};\n", parameter.name, value);
  }
  return code;
}

std::string normalOrientation(const StyleSettings* gradient) {
  const std::string word = gradient == nullptr ? "outward" : gradient->word("normal");
  if (word == "inward") return "kNormalInward";
  return word == "facing" ? "kNormalFacing" : "kNormalOutward";
}

/// Everything generated for the layers, in the order in which it must appear.
class LayerCode {
 public:
  explicit LayerCode(const Scene& scene) : scene_{scene}, gradient_{gradientNeeded(scene)} {
    for (std::size_t i = 0; i < scene.layers.size(); ++i) add(i);
  }

  std::string text() const { return curves_.text() + styleCode() + uniforms_ + shadeSample(); }

 private:
  void add(std::size_t i) {
    const Layer& layer = scene_.layers[i];
    uniforms_ += fmt::format("uniform sampler1D {};\nuniform vec3 {};\n", transferUniform(i),
                             transferScaleUniform(i));
    classify_ +=
        fmt::format("  vec4 class{0} = texture({1}, ((look.x - {2}.x) * {2}.y + 0.5) * {2}.z);\n",
                    i, transferUniform(i), transferScaleUniform(i));
    total_ += fmt::format("{}class{}.a", i == 0 ? "" : " + ", i);
    body_ += fmt::format(
        "  if (class{0}.a > 0.0) {{\n"
        "    Shading s = Shading(class{0}.rgb, class{0}.a, vec3(0.0), 0.0);\n",
        i);
    if (gradientNeededBy(layer)) addSurface(i, layer);
    addStyles(i, layer);
    body_ += "    colour += s.extinction * s.colour;\n    extinction += s.extinction;\n  }\n";
  }

  static bool gradientNeededBy(const Layer& layer) {
    return std::ranges::any_of(layer.styles, [](const StyleSettings& s) {
      const StyleSpec* spec = findStyle(s.name);
      return spec->hasSnippet && spec->needsGradient;
    });
  }

  void addSurface(std::size_t i, const Layer& layer) {
    const std::string floor = parameterUniform(i, "gradient", "noise_floor");
    uniforms_ += fmt::format("uniform float {};\nuniform float {};\n", floor, magnitudeUniform(i));
    body_ += fmt::format("    Surface g = surfaceOf(gradient, magnitude * {}, {}, {}, toEye);\n",
                         magnitudeUniform(i), floor, normalOrientation(layer.style("gradient")));
  }

  void addStyles(std::size_t i, const Layer& layer) {
    for (const StyleSettings& settings : layer.styles) {
      const StyleSpec& style = *findStyle(settings.name);
      if (!style.hasSnippet) continue;
      const ParameterCode code = parameterCode(settings, style, i, curves_);
      uniforms_ += code.uniforms;
      body_ += fmt::format("    {{\n    {0}_parameters p;\n{1}    apply_{0}(s, {2}p);\n    }}\n",
                           style.name, code.statements, style.needsGradient ? "g, " : "");
    }
    body_ += fmt::format("    drawLines(s, class{}.a);\n", i);
  }

  std::string styleCode() const {
    std::string text;
    for (const StyleSpec& style : styleTable()) {
      if (!style.hasSnippet || !usedAnywhere(scene_, style.name)) continue;
      text += declareStyle(style) + fmt::format("#include \"styles/{}.glsl\"\n", style.name);
    }
    return text;
  }

  std::string shadeSample() const {
    std::string text = gradient_ ? "uniform mat3 differencesToGradient;\n" : "";
    text +=
        "bool shadeSample(vec3 position, vec3 toEye, out vec3 colour, out float extinction) {\n"
        "  vec2 look = volumeLookUp(textureCoordinate(position));\n" +
        classify_ + "  if (look.y == 0.0 || " + total_ + " <= 0.0) return false;\n";
    if (gradient_)
      text +=
          "  vec3 gradient = differencesToGradient * volumeDifferences(position);\n"
          "  float magnitude = length(gradient);\n";
    return text + "  colour = vec3(0.0);\n  extinction = 0.0;\n" + body_ +
           "  if (extinction <= 0.0) return false;\n  colour /= extinction;\n  return true;\n}\n";
  }

  const Scene& scene_;
  bool gradient_;
  CurveSet curves_;
  std::string uniforms_, classify_, total_, body_;
};

}  // namespace

std::string parameterUniform(std::size_t layer, std::string_view style,
                             std::string_view parameter) {
  return fmt::format("layer{}_{}_{}", layer, style, parameter);
}
std::string curveUniform(std::size_t layer, std::string_view style, std::string_view parameter) {
  return parameterUniform(layer, style, parameter) + "_curve";
}
std::string transferUniform(std::size_t layer) {
  return fmt::format("transfer{}", layer);
}
std::string transferScaleUniform(std::size_t layer) {
  return fmt::format("transferScale{}", layer);
}
std::string magnitudeUniform(std::size_t layer) {
  return fmt::format("magnitude{}", layer);
}

ShaderSource generateRaycastProgram(const Scene& scene, const ProgramOptions& options) {
  std::string text = "#version 450 core\n";
  text += fmt::format("#define LIGHTS {}\n#define CLIP_PLANES {}\n", scene.lights.size(),
                      scene.clip.size());
  if (options.invalidVoxels) text += "#define INVALID_VOXELS\n";
  if (options.countSamples) text += "#define COUNT_SAMPLES\n";
  for (const char* file : {"lattice.glsl", "volume.glsl", "skip.glsl", "shading.glsl"})
    text += fmt::format("#include \"{}\"\n", file);
  text += LayerCode{scene}.text();
  text += "#include \"raycast.glsl\"\n";
  return expandIncludes(text, "raycast program");
}

}  // namespace burin::node
