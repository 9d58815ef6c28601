#pragma once

#include <string>
#include <string_view>

#include "burin/common/scene.hpp"

namespace burin::node {

/// Of a gradient by that operator; what the generated code calls it.
std::string gradientName(GradientOperator which);

/// Statements for the gradients of a scene at `coordinate` and their magnitudes, each operator's
/// once.
std::string gradientCode(const GradientOperatorSet& operators, Normals normals);

/// The same of gradients that are quantised at voxels and then filtered.
std::string filteredGradientCode(const GradientOperatorSet& operators);

/// A loop over the voxels of a cell: `coordinate` is where one lies, `share` its weight.
std::string cornerLoop(std::string_view cell, const std::string& statements);

}  // namespace burin::node
