#include "burin/common/scene.hpp"
#include "scene_keys.hpp"
#include "scene_override.hpp"
#include "style_file.hpp"
#include "text_file.hpp"
#include "transfer_function_file.hpp"

namespace burin {

Scene parseScene(std::string_view text, std::string_view name,
                 const std::vector<std::string>& overrides) {
  json::Node root = json::read(text, name);
  const std::filesystem::path folder = std::filesystem::path{name}.parent_path();
  const auto expand = [&] {
    scene_io::expandNamedStyles(root, folder);
    scene_io::expandColourMaps(root, folder);
  };
  expand();  // before each override, so that it finds the keys of what is named, and after the last
  for (const std::string& override : overrides)
    scene_io::applySceneOverride(root, override, expand);
  return scene_io::sceneCodec().read({root, ""});
}

std::string writeScene(const Scene& scene) {
  return json::format(scene_io::sceneCodec().write(scene));
}

void setSceneFolder(Scene& scene, const std::filesystem::path& folder) {
  for (std::string* name : {&scene.volume.file, &scene.labels.file, &scene.labels.names}) {
    // An absolute name replaces the folder altogether.
    if (!name->empty()) *name = (folder / *name).lexically_normal().string();
  }
}

Scene loadScene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Scene scene = parseScene(readSmallFile(file, "the scene"), file.string(), overrides);
  setSceneFolder(scene, file.parent_path());
  return scene;
}

std::string sceneSchemaJson() {
  json::Document schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                        {"title", "burin scene"}};
  schema.update(scene_io::sceneCodec().schema);
  return json::format(schema);
}

}  // namespace burin
