#include "burin/host/scene_setup.hpp"

#include <fstream>
#include <sstream>
#include <utility>

#include "burin/common/error.hpp"
#include "burin/common/log.hpp"
#include "burin/host/default_scene.hpp"
#include "burin/host/shared_error.hpp"
#include "burin/node/scanned_volume.hpp"
#include "burin/node/survey.hpp"

namespace burin::host {

namespace fs = std::filesystem;

namespace {

std::string readText(const fs::path& file) {
  // Opening a FIFO would wait for somebody to write to it.
  if (fs::exists(file) && !fs::is_regular_file(file))
    fail(ExitCode::kUsage, "{}: not a regular file (expected a scene file)", file.string());
  std::ifstream in{file, std::ios::binary};
  std::ostringstream text;
  // An empty file sets failbit on `text`, which is the parser's business, not ours.
  if (in) text << in.rdbuf();
  if (!in) fail(ExitCode::kUsage, "{}: the scene cannot be read", file.string());
  return text.str();
}

std::vector<std::string> overrides(const RenderOptions& options) {
  std::vector<std::string> all = options.settings;
  if (options.size)
    all.push_back(fmt::format("image.size=[{},{}]", options.size->width, options.size->height));
  return all;
}

/// Rank 0 alone reads what the scene names (styles); the others get the scene that came of it.
Scene parseForAll(const Communicator& comm, const std::string& text, const std::string& name,
                  const RenderOptions& options) {
  Scene scene;
  onRoot(comm, [&] { scene = parseScene(text, name, overrides(options)); });
  const std::string whole =
      broadcastText(comm, comm.isRoot() ? writeScene(scene) : std::string{}, Rank{0});
  together(comm, "the scene", [&] { scene = parseScene(whole, name); });
  return scene;
}

Scene readScene(const Communicator& comm, const RenderOptions& options) {
  const fs::path file = options.input;
  std::string text;
  onRoot(comm, [&] { text = readText(file); });
  Scene scene = parseForAll(comm, text, file.string(), options);
  if (!options.volume.empty()) {
    scene.volume = VolumeChoice{};
    scene.volume.file = options.volume;
  } else if (!scene.volume.file.empty() && fs::path{scene.volume.file}.is_relative()) {
    scene.volume.file = (file.parent_path() / scene.volume.file).lexically_normal().string();
  }
  options.raw.applyTo(scene.volume);
  return scene;
}

/// The default scene goes through its own text, so that --set works on it as on any other. Its
/// quality is the default and not in that text, so that either a step or an error can be set.
Scene sceneFromVolume(const Communicator& comm, const RenderOptions& options,
                      const VolumeChoice& choice, node::BrickSource& source,
                      const VolumeFacts& facts) {
  const auto survey = node::surveyVolume(comm, source, {});
  const MaterialProfile profile = profileMaterials(comm, source, survey);
  const std::string text = writeScene(makeDefaultScene(choice, facts, profile, survey.blocks));
  RenderOptions withoutQuality = options;
  withoutQuality.settings.insert(withoutQuality.settings.begin(), "quality=null");
  Scene scene = parseForAll(comm, text, "scene made for " + choice.file, withoutQuality);
  scene.volume = choice;
  return scene;
}

}  // namespace

std::unique_ptr<node::BrickSource> openTogether(const Communicator& comm,
                                                const VolumeChoice& choice) {
  std::unique_ptr<node::BrickSource> source;
  std::string scan;
  onRoot(comm, [&] { scan = node::scanVolume(choice); });
  scan = broadcastText(comm, std::move(scan), Rank{0});
  together(comm, "opening the volume", [&] { source = node::openScannedVolume(choice, scan); });
  if (comm.isRoot() && !source->info().notice.empty()) note("{}", source->info().notice);
  return source;
}

PreparedScene prepareScene(const Communicator& comm, const RenderOptions& options) {
  const bool hasScene = !options.input.empty() && isSceneFile(options.input);
  PreparedScene prepared;
  VolumeChoice choice;
  if (hasScene) {
    prepared.scene = readScene(comm, options);
    choice = prepared.scene.volume;
  } else {
    choice.file = options.input.empty() ? options.volume : options.input;
    options.raw.applyTo(choice);
  }
  prepared.source = openTogether(comm, choice);
  const node::VolumeInfo& info = prepared.source->info();
  prepared.facts = {info.grid, info.anatomical};
  if (!hasScene)
    prepared.scene = sceneFromVolume(comm, options, choice, *prepared.source, prepared.facts);
  resolveScene(prepared.scene, prepared.facts);
  return prepared;
}

std::string sceneTextFor(const Scene& scene, const fs::path& target) {
  Scene moved = scene;
  const fs::path file = scene.volume.file;
  if (!file.empty() && file.is_relative()) {
    const fs::path folder = fs::absolute(target).parent_path();
    moved.volume.file = fs::proximate(fs::absolute(file), folder).string();
  }
  return writeScene(moved);
}

}  // namespace burin::host
