#pragma once

#include "burin/common/gradient_operator.hpp"

namespace burin::node {

/// What an operator makes of the differences D(o) = f(p + o) - f(p - o) of opposite neighbours: the
/// difference across two voxels is Σ weight(o) o D(o), the weight by how many components of o are
/// not 0. face + 4 edge + 4 corner = 1, so that linear fields are exact.
struct OperatorWeights {
  double face = 1;
  double edge = 0;
  double corner = 0;
};

OperatorWeights operatorWeights(GradientOperator which);

}  // namespace burin::node
