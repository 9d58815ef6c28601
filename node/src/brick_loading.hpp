#pragma once

#include <span>

#include "brick.hpp"
#include "burin/common/communicator.hpp"
#include "burin/common/memory_check.hpp"
#include "burin/node/brick_source.hpp"
#include "label_masks.hpp"
#include "value_scale.hpp"

namespace burin::node {

/// What this rank's bricks will take; `boxes`: the voxels they store.
MemoryNeed memoryNeedOf(std::span<const IndexBox> boxes, const VolumeInfo& volume,
                        const ValueScale& scale, bool hasLaplacian, const LabelMasks& masks);

/// Collective. Voxels straight into textures; what is staged is a few slabs. `boxes`: what each of
/// `bricks` stores.
void loadBricks(const Communicator& comm, BrickSource& source, std::span<const IndexBox> boxes,
                std::span<Brick> bricks);

/// Collective. Of the volume `labels`, which of the masks the voxels of the bricks belong to;
/// `reach`: labelReach().
void loadLabels(const Communicator& comm, BrickSource& labels, const LabelMasks& masks, int reach,
                std::span<Brick> bricks);

}  // namespace burin::node
