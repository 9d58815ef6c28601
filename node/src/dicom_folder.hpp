#pragma once

#include <filesystem>
#include <functional>

namespace burin::node {

/// Calls visit(path) for the regular files below a folder until one call returns false. Throws
/// Error{kVolume} if a folder cannot be read.
void forFilesBelow(const std::filesystem::path& folder,
                   const std::function<bool(const std::filesystem::path&)>& visit);

/// Whether there is any DICOM file below the folder.
bool hasDicomFiles(const std::filesystem::path& folder);

}  // namespace burin::node
