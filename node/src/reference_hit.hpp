#pragma once

#include <functional>
#include <optional>

namespace burin::node {

/// Value of the volume at a depth along a ray; nothing where it has none.
using ValueAtDepth = std::function<std::optional<double>(double depth)>;

/// Where between two depths the value passes `isoValue`, to the last digit of a double: where it
/// becomes at least that, or less. Nothing if both ends lie on the same side, or if there are
/// depths without a value on the way there. Of several such depths, one.
std::optional<double> referenceHit(const ValueAtDepth& value, double isoValue, double begin,
                                   double end);

}  // namespace burin::node
