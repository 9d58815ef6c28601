#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace burin::node {

/// Whether a file is a picture, by its extension.
bool isPictureName(const std::string& name);

/// The numbered pictures of a folder, by number, whose names differ in the last number alone; none
/// if there are none. Throws Error{kVolume} if there are several sequences or a number is missing.
std::vector<std::filesystem::path> picturesIn(const std::filesystem::path& folder);

/// The files that the user means: those of a folder, or that fit "slice%03d.png", or the one file.
/// Throws as picturesIn does, and if there is none.
std::vector<std::filesystem::path> pictureFiles(const std::string& written);

}  // namespace burin::node
