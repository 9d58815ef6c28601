#pragma once

#include "burin/common/brick_tree.hpp"
#include "drawing_cost.hpp"

namespace burin::node {

/// The most costly share over the mean of all: of the owners, or of the bricks if they have one
/// owner.
double unevenness(const BrickTree& tree, const CostEstimate& cost);

/// Bricks that balance the cost. What a brick hides depends on where it ends, so that is estimated
/// with the bricks of the round before; the evenest round counts. `request`: but its cost.
BrickTree balancedTree(BrickTree::Request request, const DrawingCost& cost);

}  // namespace burin::node
