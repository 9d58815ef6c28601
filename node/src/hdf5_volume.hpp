#pragma once

#include <memory>

#include "burin/node/brick_source.hpp"

namespace burin::node {

/// The dataset that `choice.file` names, FILE:/PATH. Throws Error{kVolume} if it is none or no
/// volume, and what chosenComponent() throws.
std::unique_ptr<BrickSource> openHdf5Volume(const VolumeChoice& choice);

}  // namespace burin::node
