#pragma once

#include <glm/glm.hpp>

#include "burin/common/transfer_function.hpp"

namespace burin::node {

/// Integral of (extinction * colour, extinction) over the values from `lowest` to `highest`, points
/// inside and steps among them included. Points above kLargestOpacity count as being there.
glm::dvec4 transferIntegral(const TransferFunction& function, double unitLength, double lowest,
                            double highest);

}  // namespace burin::node
