#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "burin/common/scene.hpp"
#include "json_override.hpp"
#include "scene_keys.hpp"

namespace burin {

namespace {

/// More than any scene needs; a volume given by mistake is refused before it is read.
constexpr std::uintmax_t kLargestSceneBytes = std::uintmax_t{16} << 20;

std::string readSceneText(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error)
    fail(ExitCode::kUsage, "{}: cannot read the scene: {}", file.string(), error.message());
  if (bytes > kLargestSceneBytes) {
    fail(ExitCode::kUsage, "{}: {} bytes are no scene; expected at most {}", file.string(), bytes,
         kLargestSceneBytes);
  }
  errno = 0;
  std::ifstream stream{file, std::ios::binary};
  std::string text{std::istreambuf_iterator<char>{stream}, {}};
  if (!stream.is_open() || stream.bad()) {
    fail(ExitCode::kUsage, "{}: cannot read the scene: {}", file.string(), std::strerror(errno));
  }
  return text;
}

}  // namespace

Scene parseScene(std::string_view text, std::string_view name,
                 const std::vector<std::string>& overrides) {
  json::Node root = json::read(text, name);
  for (const std::string& override : overrides) json::applyOverride(root, override);
  return scene_io::sceneCodec().read({root, ""});
}

std::string writeScene(const Scene& scene) {
  return json::format(scene_io::sceneCodec().write(scene));
}

Scene loadScene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Scene scene = parseScene(readSceneText(file), file.string(), overrides);
  if (!scene.volume.file.empty()) {
    // An absolute volume.file replaces the folder altogether.
    scene.volume.file = (file.parent_path() / scene.volume.file).lexically_normal().string();
  }
  return scene;
}

std::string sceneSchemaJson() {
  json::Document schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                        {"title", "burin scene"}};
  schema.update(scene_io::sceneCodec().schema);
  return json::format(schema);
}

}  // namespace burin
