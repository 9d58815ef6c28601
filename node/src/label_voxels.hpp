#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "burin/node/brick_source.hpp"

namespace burin::node {

/// The labels that voxel bytes of a label volume's type say. Throws Error{kVolume} naming the
/// volume for a voxel that is not a whole number of at most kLargestLabel either way.
void readLabels(const VolumeInfo& info, std::span<const std::byte> voxels,
                std::vector<int>& labels);

}  // namespace burin::node
