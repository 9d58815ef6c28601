#include "operator_weights.hpp"

#include <cmath>

namespace burin::node {

OperatorWeights operatorWeights(GradientOperator which) {
  OperatorWeights weights;
  if (which == GradientOperator::kSobel) weights = {4, 2, 1};
  if (which == GradientOperator::kRegression) weights = {1, 1 / std::sqrt(2.0), 1 / std::sqrt(3.0)};
  const double sum = weights.face + 4 * weights.edge + 4 * weights.corner;
  return {weights.face / sum, weights.edge / sum, weights.corner / sum};
}

}  // namespace burin::node
