#pragma once

#include <string>

#include "burin/node/brick_source.hpp"

namespace burin::node {

// HDF5 and DCMTK bring some twenty libraries, whose relocations take time in every process; so the
// readers that need them are in a module, opened where such a file is read. These are its
// functions, by their names; module_formats.cpp calls them. The caller owns the source.

using OpenInModule = BrickSource*(const VolumeChoice& choice);
using ScanInModule = void(const VolumeChoice& choice, std::string& scan);
using OpenScannedInModule = BrickSource*(const VolumeChoice& choice, const std::string& scan);

inline constexpr const char* kOpenHdf5 = "burinOpenHdf5";
inline constexpr const char* kScanDicom = "burinScanDicom";
inline constexpr const char* kOpenDicom = "burinOpenDicom";

}  // namespace burin::node
