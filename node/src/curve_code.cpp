#include "curve_code.hpp"

#include <fmt/format.h>

namespace burin::node {

std::string CurveCode::keepArray(const std::string& uniform, std::size_t size) {
  std::string kept = "kept_" + uniform;
  declarations_ += fmt::format("uniform vec3 {0}[{2}];\nvec3 {1}[{2}];\n", uniform, kept, size);
  prepare_ +=
      fmt::format("  for (int i = 0; i < {0}; ++i) {1}[i] = one * {2}[i];\n", size, kept, uniform);
  return kept;
}

int CurveCode::add(const std::string& uniform, const Curve& curve) {
  const int number = curves_++;
  const std::string kept = keepArray(uniform, curve.points.size());
  cases_ += fmt::format("  if (number == {}) {{\n    y = {}[0].x;\n", number, kept);
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    cases_ +=
        fmt::format("    y += {0}[{1}].z * clamp(x - {0}[{1}].x, 0.0, {0}[{1}].y);\n", kept, i);
  cases_ += "  }\n";
  return number;
}

int CurveCode::add(const std::string& uniform, const ColourCurve& curve) {
  const int number = colourCurves_++;
  const std::string kept = keepArray(uniform, curve.points.size());
  const std::string ramps = keepArray(rampsUniform(uniform), curve.points.size());
  colourCases_ += fmt::format("  if (number == {}) {{\n    y = {}[0];\n", number, kept);
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    colourCases_ +=
        fmt::format("    y += {0}[{2}] * ({1}[{2}].z * clamp(x - {1}[{2}].x, 0.0, {1}[{2}].y));\n",
                    kept, ramps, i);
  colourCases_ += "  }\n";
  return number;
}

std::string CurveCode::text() const {
  std::string text = declarations_;
  if (curves_ > 0)
    text += "float evaluateCurve(int number, float x) {\n  float y = 0.0;\n" + cases_ +
            "  return y;\n}\n";
  if (colourCurves_ > 0)
    text += "vec3 evaluateColourCurve(int number, float x) {\n  vec3 y = vec3(0.0);\n" +
            colourCases_ + "  return y;\n}\n";
  return text;
}

std::string rampsUniform(const std::string& uniform) {
  return uniform + "_ramps";
}

}  // namespace burin::node
