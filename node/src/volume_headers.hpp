#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "burin/node/brick_source.hpp"

namespace burin::node {

/// Whether the grid is nothing but spacings: origin 0, axes along the world's.
bool isPlainGrid(const VolumeGrid& grid);

/// The text of an NRRD header for voxels in native byte order, with the empty line that ends an
/// attached one. `dataFile`: name of the file with the voxels; empty for an attached header.
std::string nrrdHeader(const VolumeInfo& info, bool gzip, std::string_view dataFile);

/// The 352 bytes before the voxels of a NIfTI-1 file. Throws Error{kUsage} if an axis is longer
/// than the format can say (32767). `name`: how messages call the file.
std::vector<std::byte> niftiHeader(const VolumeInfo& info, std::string_view name);

}  // namespace burin::node
