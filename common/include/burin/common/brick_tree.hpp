#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "burin/common/camera.hpp"
#include "burin/common/geometry.hpp"

namespace burin {

enum class BrickId : std::uint32_t {};

/// k-d tree over the cells of a volume. Leaves are bricks, numbered 0, 1, … from left to right. The
/// upper levels split among *owners* (indices 0 … owners-1 of the ranks that render), the lower
/// ones among the bricks of one owner, so an owner's bricks are a subtree: consecutive in every
/// visibility order.
class BrickTree {
 public:
  struct Node {
    IndexBox cells;
    int axis = -1;  ///< split axis, -1 at a leaf
    int plane = 0;  ///< split index (a voxel index): left has cells < plane
    int left = -1;  ///< index of the left child, -1 at a leaf
    int right = -1;
    int owner = -1;           ///< owner if the whole subtree has one, else -1
    std::uint32_t brick = 0;  ///< leaf only
    friend bool operator==(const Node&, const Node&) = default;
  };

  /// Estimated cost of drawing a box of cells: finite, >= 0, additive over disjoint boxes.
  using Cost = std::function<double(const IndexBox& cells)>;
  /// Whether a box of cells must be split further (a texture limit); may be empty.
  using TooLarge = std::function<bool(const IndexBox& cells)>;

  struct Request {
    VolumeGrid grid;
    int owners = 1;  ///< ranks that render, >= 1; if there are fewer cells, the rest stay idle
    int bricks = 0;  ///< total bricks wanted; 0: one per owner. Raised to owners if smaller.
    Cost cost;
    TooLarge tooLarge;
  };

  /// Splits n owners (then n bricks) into ⌈n/2⌉ and ⌊n/2⌋ with the plane, of any axis, that
  /// balances cost in that ratio (volume where the cost is 0 or absent); deterministic. Never makes
  /// an empty brick: with fewer cells than bricks there are fewer bricks. `tooLarge` bricks are
  /// halved further, beyond the number wanted.
  static BrickTree build(const Request& request);

  const VolumeGrid& grid() const { return grid_; }
  std::span<const Node> nodes() const { return nodes_; }  ///< node 0 is the root
  std::size_t brickCount() const { return leaves_.size(); }
  /// Owners that own at least one brick: 0 … ownerCount()-1.
  int ownerCount() const { return ownerCount_; }
  const IndexBox& brickCells(BrickId brick) const;
  int brickOwner(BrickId brick) const;
  std::vector<BrickId> bricksOf(int owner) const;

  /// Bricks front to back for this camera, from the split planes: for a perspective eye its side of
  /// each plane, for a parallel view the sign of the view direction. With the eye (or the view) in
  /// a split plane either order is right, and the left child comes first.
  std::vector<BrickId> visibilityOrder(const Camera& camera) const;
  /// Owners front to back, each once; the same order as their bricks.
  std::vector<int> ownerVisibilityOrder(const Camera& camera) const;

 private:
  VolumeGrid grid_;
  std::vector<Node> nodes_;
  std::vector<int> leaves_;  ///< node index by brick
  int ownerCount_ = 0;
};

}  // namespace burin
