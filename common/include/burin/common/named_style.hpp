#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "burin/common/style.hpp"

namespace burin {

/// A look that a layer's "style" can name: a file NAME.json that holds
/// { "description": "one line", "style": { … as of a layer … } }.
struct NamedStyle {
  std::string name;
  std::string description;
  std::vector<StyleSettings> effects;  ///< in the order of styleTable()
};

/// Folders that are searched for named styles, the first one first: those in the environment
/// variable BURIN_STYLES (separated by colons), then the one that came with the running program:
/// share/burin/configs/styles where it is installed, configs/styles of the sources where it was
/// built. Only those that exist.
std::vector<std::filesystem::path> styleFolders();

/// Every named style in `folders`, sorted by name; of several with one name the first found. Throws
/// Error{kUsage} if one of the files is no style.
std::vector<NamedStyle> findNamedStyles(const std::vector<std::filesystem::path>& folders);

}  // namespace burin
