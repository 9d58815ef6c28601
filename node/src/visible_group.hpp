#pragma once

#include <optional>
#include <span>
#include <vector>

#include "burin/node/label_volume.hpp"
#include "label_masks.hpp"
#include "visible_blocks.hpp"
#include "visible_values.hpp"

namespace burin::node {

/// What the layers of a scene show that are bound to the same labels, or to none.
struct VisibleGroup {
  VisibleValues values;
  std::optional<int> mask;  ///< of labels; nothing: everywhere
  LabelSet labels = 0;      ///< those of the mask
};

/// Of all layers.
std::vector<VisibleGroup> visibleGroups(const Scene& scene, const LabelMasks& masks,
                                        const ValueScale& scale);

/// VisibleBlocks::mark() for all groups together. `labels`: LabelSurvey::blocks, needed if a group
/// has a mask; `reach`: a voxel with a value that shows is seen in the labels up to so many voxels
/// away.
std::vector<std::uint8_t> markBlocks(const VisibleBlocks& blocks,
                                     std::span<const VisibleGroup> groups,
                                     std::span<const LabelSet> labels, int reach,
                                     std::span<const glm::vec4> clipPlanes, const VolumeGrid& grid);

}  // namespace burin::node
