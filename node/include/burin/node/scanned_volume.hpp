#pragma once

#include <memory>
#include <string>

#include "burin/node/brick_source.hpp"

namespace burin::node {

/// What the headers of a volume in many files (a DICOM folder) say, so that one rank alone reads
/// them; empty for other volumes. Local. Throws as openVolume() does.
std::string scanVolume(const VolumeChoice& choice);

/// As openVolume(), of what scanVolume() returned for the same choice, here or on another rank.
std::unique_ptr<BrickSource> openScannedVolume(const VolumeChoice& choice, const std::string& scan);

}  // namespace burin::node
