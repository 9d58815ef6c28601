#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "json_node.hpp"

namespace burin::scene_io {

/// What a style file says, not yet checked against the style table.
struct StyleFile {
  std::string description;
  json::Node style;
};

/// Throws Error{kUsage} if the file cannot be read or has other keys than those two.
StyleFile readStyleFile(const std::filesystem::path& file);

/// Puts the file's content in place of each layer's "style" that is a name, and under each one with
/// a "base": without what "without" lists, and overruled by the parameters beside it. A name with a
/// slash or with the ending .json is a file, relative to `folder`; others are looked up in
/// styleFolders(). Throws Error{kUsage}, for an unknown name with the nearest one.
void expandNamedStyles(json::Node& scene, const std::filesystem::path& folder);

}  // namespace burin::scene_io
