#pragma once

#include <optional>

#include "burin/common/brick_tree.hpp"

namespace burin {

/// A plane of constant index that cuts a box of cells: left has cells < plane.
struct SplitPlane {
  int axis = 0;
  int plane = 0;
  double imbalance = 0;  ///< |cost left of it - wanted| / cost of the box
};

/// What a cut must give its left side: a share of the cost, and room for the bricks to come.
struct SplitDemand {
  double leftShare = 0.5;      ///< of the cost, in (0, 1)
  std::int64_t leftCells = 1;  ///< at least
  std::int64_t rightCells = 1;
};

/// The plane, of any axis, that best gives the left side its share of the cost: the longest axis
/// (in the world) unless another balances clearly better. Among equally good planes of an axis
/// (empty space) the one nearest to the same share of the length. Empty if no single plane leaves
/// both sides enough cells. Calls `cost` O(log n) times.
std::optional<SplitPlane> balancedPlane(const VolumeGrid& grid, const IndexBox& cells,
                                        const BrickTree::Cost& cost, const SplitDemand& demand);

/// The plane at `share` of the axis with most cells. The box must have two cells or more.
SplitPlane volumePlane(const IndexBox& cells, double share);

/// The cells on either side of a plane.
IndexBox leftOf(const IndexBox& cells, int axis, int plane);
IndexBox rightOf(const IndexBox& cells, int axis, int plane);

}  // namespace burin
