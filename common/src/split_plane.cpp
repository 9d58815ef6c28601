#include "split_plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "burin/common/error.hpp"

namespace burin {

namespace {

/// A shorter axis must balance better by this much of the box's cost: long thin bricks cost ghosts
/// and footprint, which the cost estimate does not see.
constexpr double kWorthAnotherAxis = 0.05;
/// Costs are sums of many terms in changing order; smaller differences than this mean nothing.
constexpr double kCostNoise = 1e-9;

/// z before y before x where equal: slabs of whole slices are contiguous in files.
std::array<int, 3> longestAxesFirst(const VolumeGrid& grid, const IndexBox& cells) {
  std::array<int, 3> axes{2, 1, 0};
  const glm::dvec3 extent = glm::dvec3{cells.size()} * grid.spacing;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = i + 1; j < 3; ++j) {
      // Equal spacings may differ in their last digits after a file's header.
      if (extent[axes[j]] > extent[axes[i]] * (1 + 1e-6)) {
        std::rotate(axes.begin() + static_cast<std::ptrdiff_t>(i),
                    axes.begin() + static_cast<std::ptrdiff_t>(j),
                    axes.begin() + static_cast<std::ptrdiff_t>(j) + 1);
      }
    }
  }
  return axes;
}

/// First plane in [begin, end] for which `isTrue`, which must not become false again; `end` if
/// none.
template <typename Predicate>
int firstPlane(int begin, int end, Predicate isTrue) {
  while (begin < end) {
    const int middle = begin + (end - begin) / 2;
    if (isTrue(middle)) {
      end = middle;
    } else {
      begin = middle + 1;
    }
  }
  return begin;
}

int planeAtShare(const IndexBox& cells, int axis, double share) {
  return cells.lo[axis] + static_cast<int>(std::lround(share * cells.size()[axis]));
}

/// The best of the planes first … last of one axis.
SplitPlane bestPlane(const IndexBox& cells, int axis, int first, int last,
                     const BrickTree::Cost& cost, double total, double leftShare) {
  const double noise = kCostNoise * total;
  const double wanted = leftShare * total;
  const int middle = std::clamp(planeAtShare(cells, axis, leftShare), first, last);
  const auto costLeft = [&](int plane) { return cost(leftOf(cells, axis, plane)); };
  const auto nearestMiddleOfCost = [&](double value) {
    const int begin =
        firstPlane(first, last, [&](int plane) { return costLeft(plane) >= value - noise; });
    const int end =
        firstPlane(begin, last, [&](int plane) { return costLeft(plane) > value + noise; });
    const bool endIsBeyond = costLeft(end) > value + noise;
    return std::clamp(middle, begin, std::max(begin, endIsBeyond ? end - 1 : end));
  };

  const int above = firstPlane(first, last, [&](int plane) { return costLeft(plane) >= wanted; });
  const int below = std::max(first, above - 1);
  const double excess = std::abs(costLeft(above) - wanted);
  const double lack = std::abs(costLeft(below) - wanted);
  int plane = nearestMiddleOfCost(costLeft(excess <= lack ? above : below));
  if (std::abs(excess - lack) <= noise) {
    const int other = nearestMiddleOfCost(costLeft(excess <= lack ? below : above));
    if (std::abs(other - middle) < std::abs(plane - middle)) plane = other;
  }
  return {axis, plane, total > 0 ? std::min(excess, lack) / total : 0};
}

}  // namespace

IndexBox leftOf(const IndexBox& cells, int axis, int plane) {
  IndexBox left = cells;
  left.hi[axis] = plane;
  return left;
}

IndexBox rightOf(const IndexBox& cells, int axis, int plane) {
  IndexBox right = cells;
  right.lo[axis] = plane;
  return right;
}

std::optional<SplitPlane> balancedPlane(const VolumeGrid& grid, const IndexBox& cells,
                                        const BrickTree::Cost& cost, const SplitDemand& demand) {
  const double total = cost(cells);
  BURIN_CHECK(std::isfinite(total) && total >= 0);
  std::optional<SplitPlane> best;
  for (const int axis : longestAxesFirst(grid, cells)) {
    const std::int64_t length = cells.size()[axis];
    const std::int64_t slice = static_cast<std::int64_t>(cells.count()) / length;
    const std::int64_t leftLength = (demand.leftCells + slice - 1) / slice;
    const std::int64_t rightLength = (demand.rightCells + slice - 1) / slice;
    if (leftLength + rightLength > length) continue;
    const SplitPlane plane =
        bestPlane(cells, axis, cells.lo[axis] + static_cast<int>(leftLength),
                  cells.hi[axis] - static_cast<int>(rightLength), cost, total, demand.leftShare);
    if (!best || plane.imbalance < best->imbalance - kWorthAnotherAxis) best = plane;
  }
  return best;
}

SplitPlane volumePlane(const IndexBox& cells, double share) {
  const glm::ivec3 size = cells.size();
  int axis = 2;
  for (const int other : {1, 0}) {
    if (size[other] > size[axis]) axis = other;
  }
  BURIN_CHECK(size[axis] >= 2);
  return {axis,
          std::clamp(planeAtShare(cells, axis, share), cells.lo[axis] + 1, cells.hi[axis] - 1), 0};
}

}  // namespace burin
