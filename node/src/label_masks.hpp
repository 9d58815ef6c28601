#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "burin/common/scene.hpp"

namespace burin::node {

/// Masks that a voxel belongs to, a bit for each.
using MaskBits = std::uint16_t;
static_assert(kMostListed <= 16);

/// The sets of labels that a scene's layers are bound to: each set that occurs is a mask.
class LabelMasks {
 public:
  LabelMasks() = default;  ///< none
  /// Labels must be resolved to numbers.
  explicit LabelMasks(const Scene& scene);

  /// Ascending labels of each mask, in the order of the layers.
  const std::vector<std::vector<int>>& sets() const { return sets_; }
  /// The mask of a layer of that scene; -1 for one that is everywhere.
  int of(const Layer& layer) const;

  /// The masks that each label belongs to, into `bits` (as many).
  void bitsOf(std::span<const int> labels, std::vector<MaskBits>& bits) const;

 private:
  std::vector<std::vector<int>> sets_;
  std::vector<std::pair<int, MaskBits>> ofLabel_;  ///< ascending; others belong to none
};

}  // namespace burin::node
