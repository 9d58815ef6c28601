#include "burin/common/brick_tree.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "burin/common/error.hpp"
#include "split_plane.hpp"

namespace burin {

namespace {

/// What a subtree has to divide: owners firstOwner …, and bricks for them, at least one each.
struct Share {
  int firstOwner = 0;
  int owners = 1;
  std::int64_t bricks = 1;
};

/// The left part of a share: half the owners (the larger half), and bricks so that every owner ends
/// up with as many as any other, or one fewer. A single owner's bricks are halved.
Share leftPart(const Share& whole) {
  if (whole.owners == 1) return {whole.firstOwner, 1, (whole.bricks + 1) / 2};
  const int owners = (whole.owners + 1) / 2;
  return {whole.firstOwner, owners, (whole.bricks * owners + whole.owners - 1) / whole.owners};
}

Share rest(const Share& whole, const Share& left) {
  if (whole.owners == 1) return {whole.firstOwner, 1, whole.bricks - left.bricks};
  return {whole.firstOwner + left.owners, whole.owners - left.owners, whole.bricks - left.bricks};
}

/// Moves bricks and owners to the side that has the cells for them. Nothing changes where both
/// have.
Share fitted(Share left, const Share& whole, std::int64_t leftCells, std::int64_t rightCells) {
  left.bricks = std::clamp(left.bricks, std::max<std::int64_t>(1, whole.bricks - rightCells),
                           std::min(whole.bricks - 1, leftCells));
  if (whole.owners > 1) {
    const std::int64_t rightBricks = whole.bricks - left.bricks;
    left.owners = static_cast<int>(
        std::clamp<std::int64_t>(left.owners, std::max<std::int64_t>(1, whole.owners - rightBricks),
                                 std::min<std::int64_t>(whole.owners - 1, left.bricks)));
  }
  return left;
}

class Builder {
 public:
  Builder(const BrickTree::Request& request, const BrickTree::Cost& cost)
      : request_{request}, cost_{cost} {}

  int build(const IndexBox& cells, const Share& share) {
    const std::size_t index = nodes_.size();
    BrickTree::Node& node = nodes_.emplace_back();
    node.cells = cells;
    node.owner = share.owners == 1 ? share.firstOwner : -1;
    if (share.bricks > 1) {
      divide(index, share);
    } else if (request_.tooLarge && request_.tooLarge(cells)) {
      // A limit is about voxels, not about cost; both halves stay with the owner.
      attach(index, volumePlane(cells, 0.5), share, share);
    } else {
      node.brick = static_cast<std::uint32_t>(leaves_.size());
      leaves_.push_back(static_cast<int>(index));
    }
    return static_cast<int>(index);
  }

  std::vector<BrickTree::Node> takeNodes() { return std::move(nodes_); }
  std::vector<int> takeLeaves() { return std::move(leaves_); }

 private:
  void divide(std::size_t index, const Share& share) {
    const IndexBox cells = nodes_[index].cells;
    const Share wanted = leftPart(share);
    const double leftShare =
        share.owners > 1 ? static_cast<double>(wanted.owners) / share.owners
                         : static_cast<double>(wanted.bricks) / static_cast<double>(share.bricks);
    const auto balanced = balancedPlane(request_.grid, cells, cost_,
                                        {leftShare, wanted.bricks, share.bricks - wanted.bricks});
    const SplitPlane plane = balanced ? *balanced : volumePlane(cells, leftShare);
    const auto cellsOf = [](const IndexBox& box) { return static_cast<std::int64_t>(box.count()); };
    const Share left = fitted(wanted, share, cellsOf(leftOf(cells, plane.axis, plane.plane)),
                              cellsOf(rightOf(cells, plane.axis, plane.plane)));
    attach(index, plane, left, rest(share, left));
  }

  void attach(std::size_t index, const SplitPlane& plane, const Share& left, const Share& right) {
    const IndexBox cells = nodes_[index].cells;
    const int leftIndex = build(leftOf(cells, plane.axis, plane.plane), left);
    const int rightIndex = build(rightOf(cells, plane.axis, plane.plane), right);
    BrickTree::Node& node = nodes_[index];  // only now: building moved the nodes
    node.axis = plane.axis;
    node.plane = plane.plane;
    node.left = leftIndex;
    node.right = rightIndex;
  }

  const BrickTree::Request& request_;
  const BrickTree::Cost& cost_;
  std::vector<BrickTree::Node> nodes_;
  std::vector<int> leaves_;
};

/// Where the viewer stands among the split planes, in index space.
struct Viewpoint {
  bool parallel;
  glm::dvec3 eyeIndex;        ///< perspective
  glm::dvec3 directionIndex;  ///< parallel: of the view, away from the viewer

  Viewpoint(const Camera& camera, const VolumeGrid& grid)
      : parallel{camera.projection == Projection::kOrthographic},
        eyeIndex{grid.indexFromWorld(camera.eyeWorld)},
        directionIndex{grid.worldToIndex() * camera.forward} {}

  bool seesLeftFirst(int axis, int plane) const {
    return parallel ? directionIndex[axis] >= 0 : eyeIndex[axis] <= plane;
  }
};

}  // namespace

BrickTree BrickTree::build(const Request& request) {
  BURIN_CHECK(request.owners >= 1);
  const IndexBox cells{glm::ivec3{0}, request.grid.cells()};
  const auto cellCount = static_cast<std::int64_t>(cells.count());
  const Cost volume = [](const IndexBox& box) { return static_cast<double>(box.count()); };

  BrickTree tree;
  tree.grid_ = request.grid;
  tree.ownerCount_ = static_cast<int>(std::min<std::int64_t>(request.owners, cellCount));
  const std::int64_t bricks =
      std::min<std::int64_t>(std::max(request.bricks, tree.ownerCount_), cellCount);
  Builder builder{request, request.cost ? request.cost : volume};
  builder.build(cells, {0, tree.ownerCount_, bricks});
  tree.nodes_ = builder.takeNodes();
  tree.leaves_ = builder.takeLeaves();
  return tree;
}

const IndexBox& BrickTree::brickCells(BrickId brick) const {
  const auto index = static_cast<std::size_t>(brick);
  BURIN_CHECK(index < leaves_.size());
  return nodes_[static_cast<std::size_t>(leaves_[index])].cells;
}

int BrickTree::brickOwner(BrickId brick) const {
  const auto index = static_cast<std::size_t>(brick);
  BURIN_CHECK(index < leaves_.size());
  return nodes_[static_cast<std::size_t>(leaves_[index])].owner;
}

std::vector<BrickId> BrickTree::bricksOf(int owner) const {
  std::vector<BrickId> bricks;
  for (const int leaf : leaves_) {
    const Node& node = nodes_[static_cast<std::size_t>(leaf)];
    if (node.owner == owner) bricks.push_back(BrickId{node.brick});
  }
  return bricks;
}

std::vector<BrickId> BrickTree::visibilityOrder(const Camera& camera) const {
  const Viewpoint viewpoint{camera, grid_};
  std::vector<BrickId> order;
  order.reserve(leaves_.size());
  std::vector<int> pending{0};
  while (!pending.empty()) {
    const Node& node = nodes_[static_cast<std::size_t>(pending.back())];
    pending.pop_back();
    if (node.axis < 0) {
      order.push_back(BrickId{node.brick});
      continue;
    }
    const bool leftFirst = viewpoint.seesLeftFirst(node.axis, node.plane);
    pending.push_back(leftFirst ? node.right : node.left);
    pending.push_back(leftFirst ? node.left : node.right);
  }
  return order;
}

std::vector<int> BrickTree::ownerVisibilityOrder(const Camera& camera) const {
  std::vector<int> owners;
  for (const BrickId brick : visibilityOrder(camera)) {
    const int owner = brickOwner(brick);
    if (owners.empty() || owners.back() != owner) owners.push_back(owner);
  }
  return owners;
}

}  // namespace burin
