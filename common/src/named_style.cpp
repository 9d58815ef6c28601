#include "burin/common/named_style.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <string>

#include "layer_keys.hpp"
#include "style_file.hpp"

namespace burin {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> separated(std::string_view list) {
  std::vector<std::string> parts;
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(':'), list.size());
    if (end > 0) parts.emplace_back(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return parts;
}

}  // namespace

std::vector<fs::path> styleFolders() {
  std::vector<fs::path> folders;
  if (const char* chosen = std::getenv("BURIN_STYLES"))
    for (const std::string& folder : separated(chosen)) folders.emplace_back(folder);
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  folders.push_back(program / "../share/burin/configs/styles");  // PREFIX/bin
  folders.push_back(program / "../../../configs/styles");        // build/PRESET/bin
  std::erase_if(folders, [&](const fs::path& folder) { return !fs::is_directory(folder, error); });
  return folders;
}

std::vector<NamedStyle> findNamedStyles(const std::vector<fs::path>& folders) {
  std::map<std::string, NamedStyle> found;
  for (const fs::path& folder : folders) {
    for (const auto& entry : fs::directory_iterator{folder}) {
      const fs::path& file = entry.path();
      const std::string name = file.stem().string();
      if (file.extension() != ".json" || found.contains(name)) continue;
      scene_io::StyleFile content = scene_io::readStyleFile(file);
      found[name] = {name, std::move(content.description),
                     scene_io::stylesCodec().read({content.style, "style"})};
    }
  }
  std::vector<NamedStyle> styles;
  for (auto& [name, style] : found) styles.push_back(std::move(style));
  return styles;
}

}  // namespace burin
