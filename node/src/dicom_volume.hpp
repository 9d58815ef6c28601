#pragma once

#include <memory>
#include <string>

#include "burin/node/brick_source.hpp"

namespace burin::node {

/// What the headers say of the images that `choice` means, in bytes for openDicomVolume() on this
/// and other ranks. Throws what findDicomSeries() throws.
std::string scanDicomVolume(const VolumeChoice& choice);

/// The volume of scanned images. Throws Error{kVolume} if they make no volume or if their pixels
/// cannot be read, and what chosenComponent() throws.
std::unique_ptr<BrickSource> openDicomVolume(const VolumeChoice& choice, const std::string& scan);

}  // namespace burin::node
