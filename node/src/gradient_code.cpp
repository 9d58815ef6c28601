#include "gradient_code.hpp"

#include <fmt/format.h>

#include "operator_weights.hpp"
#include "program_needs.hpp"

namespace burin::node {

namespace {

/// The matrix that makes a gradient of differences, as copied before the loop.
constexpr const char* kToGradient = "kept_differencesToGradient";

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

}  // namespace

std::string gradientName(GradientOperator which) {
  if (which == GradientOperator::kSobel) return "sobelGradient";
  return which == GradientOperator::kRegression ? "regressionGradient" : "centralGradient";
}

std::string cornerLoop(std::string_view cell, const std::string& statements) {
  return fmt::format(
      "  Cell cell = {};\n  for (int corner = 0; corner < 8; ++corner) {{\n"
      "    vec3 coordinate = cornerCoordinate(cell, corner);\n"
      "    float share = cornerShare(cell, corner);\n{}  }}\n",
      cell, statements);
}

std::string gradientCode(const GradientOperatorSet& operators, Normals normals) {
  const char* const palette = normals == Normals::kQuantised ? "quantisedGradient" : "";
  std::string text = neighbourhoodCode(operators);
  for (const GradientOperator which : kAllGradientOperators)
    if (operators.contains(which))
      text += fmt::format("  vec3 {0} = {1}({2});\n  float {0}Magnitude = length({0});\n",
                          gradientName(which), palette, gradientExpression(which, operators));
  return text;
}

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

}  // namespace burin::node
