#pragma once

#include <memory>

#include "burin/node/brick_source.hpp"

namespace burin::host::bench {

/// Local. `side`³ voxels (u8, spacing 1), 255 in `count` equal balls that hold `fraction` (in (0,
/// 1]) of the voxels together, 0 elsewhere: one ball in the middle, or several spread evenly, at
/// the same places for every fraction; large ones may touch. With a fraction of 1 all voxels are
/// 255.
std::unique_ptr<node::BrickSource> makeBalls(int count, double fraction, int side);

}  // namespace burin::host::bench
