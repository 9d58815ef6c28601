#include "balanced_tree.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace burin::node {

double unevenness(const BrickTree& tree, const CostEstimate& cost) {
  const bool isAlone = tree.ownerCount() == 1;
  std::vector<double> shares(isAlone ? tree.brickCount()
                                     : static_cast<std::size_t>(tree.ownerCount()));
  double sum = 0;
  for (std::size_t i = 0; i < tree.brickCount(); ++i) {
    const BrickId brick{static_cast<std::uint32_t>(i)};
    const double share = cost(tree.brickCells(brick));
    shares[isAlone ? i : static_cast<std::size_t>(tree.brickOwner(brick))] += share;
    sum += share;
  }
  return sum > 0 ? std::ranges::max(shares) * static_cast<double>(shares.size()) / sum : 1;
}

BrickTree balancedTree(BrickTree::Request request, const DrawingCost& cost) {
  constexpr int kRounds = 3;  // it settles in two
  request.cost = cost.unhidden();
  BrickTree tree = BrickTree::build(request);
  if (!cost.isHiding() || tree.brickCount() == 1) return tree;
  CostEstimate hidden = cost.with(tree);
  BrickTree evenest = tree;
  double least = unevenness(tree, hidden);
  for (int round = 0; round < kRounds; ++round) {
    request.cost = hidden;
    tree = BrickTree::build(request);
    hidden = cost.with(tree);
    const double now = unevenness(tree, hidden);
    if (now < least) {
      least = now;
      evenest = tree;
    }
  }
  return evenest;
}

}  // namespace burin::node
