#include "burin/host/scene_setup.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <utility>

#include "burin/common/error.hpp"
#include "burin/common/log.hpp"
#include "burin/host/default_scene.hpp"
#include "burin/host/shared_error.hpp"
#include "burin/node/label_volume.hpp"
#include "burin/node/scanned_volume.hpp"
#include "burin/node/survey.hpp"
#include "label_scene.hpp"
#include "label_setup.hpp"

namespace burin::host {

namespace fs = std::filesystem;

namespace {

std::string readText(const fs::path& file) {
  // Opening a FIFO would wait for somebody to write to it.
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
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
  setSceneFolder(scene, file.parent_path());
  if (!options.volume.empty()) {
    scene.volume = VolumeChoice{};
    scene.volume.file = options.volume;
  }
  options.raw.applyTo(scene.volume);
  options.labels.applyTo(scene.labels);
  return scene;
}

/// A scene made for a file goes through its own text, so that --set works on it as on any other.
/// Its quality is the default and taken out of that text, so that either a step or an error can be
/// set.
Scene parseMadeScene(const Communicator& comm, const std::string& text, const std::string& madeFor,
                     const RenderOptions& options) {
  RenderOptions withoutQuality = options;
  withoutQuality.settings.insert(withoutQuality.settings.begin(), "quality=null");
  // Without folders: files that settings name are looked for where the program was started.
  const std::string name = fs::path{madeFor}.filename().string();
  return parseForAll(comm, text, "scene made for " + name, withoutQuality);
}

/// Leaves in `prepared` the survey that the scene is made from, with the gradients that such scenes
/// are drawn with.
Scene sceneFromVolume(const Communicator& comm, const RenderOptions& options,
                      const VolumeChoice& choice, PreparedScene& prepared) {
  node::KnownSurvey& known = prepared.survey.emplace();
  known.request.gradients = GradientOperatorSet{GradientOperator::kCentral};
  known.survey = node::surveyVolume(comm, *prepared.source, known.request);
  const MaterialProfile profile = profileMaterials(comm, *prepared.source, known.survey);
  const std::string text =
      writeScene(makeDefaultScene(choice, prepared.facts, profile, known.survey.blocks));
  Scene scene = parseMadeScene(comm, text, choice.file, options);
  scene.volume = choice;
  return scene;
}

Scene sceneFromLabels(const Communicator& comm, const RenderOptions& options,
                      const VolumeChoice& choice, const LabelVolumeChoice& labels,
                      const PreparedScene& prepared) {
  const auto survey = node::surveyLabels(comm, *prepared.labels);
  std::string text;
  onRoot(comm, [&] {
    text = writeScene(makeLabelScene(choice, labels, prepared.facts, prepared.labelInfos, survey));
    const auto count =
        std::ranges::count_if(survey.voxels, [](const auto& l) { return l.first != 0; });
    if (count > kMostLabelLayers)
      note("{}: {} labels, of which the {} with most voxels have a colour of their own",
           labels.file, count, kMostLabelLayers - 1);
  });
  Scene scene = parseMadeScene(comm, text, labels.file, options);
  scene.volume = choice;
  scene.labels = labels;
  return scene;
}

}  // namespace

std::unique_ptr<node::BrickSource> openTogether(const Communicator& comm,
                                                const VolumeChoice& choice) {
  std::unique_ptr<node::BrickSource> source;
  std::string scan;
  onRoot(comm, [&] {
    if (choice.file.empty() && choice.procedural.empty())
      fail(ExitCode::kUsage, "no volume is named (expected 'volume' in the scene, or --volume)");
    scan = node::scanVolume(choice);
  });
  scan = broadcastText(comm, std::move(scan), Rank{0});
  together(comm, "opening the volume", [&] { source = node::openScannedVolume(choice, scan); });
  if (comm.isRoot() && !source->info().notice.empty()) note("{}", source->info().notice);
  return source;
}

PreparedScene prepareScene(const Communicator& comm, const RenderOptions& options) {
  const bool hasScene = !options.input.empty() && isSceneFile(options.input);
  PreparedScene prepared;
  VolumeChoice choice;
  LabelVolumeChoice labels;
  if (hasScene) {
    prepared.scene = readScene(comm, options);
    choice = prepared.scene.volume;
    labels = prepared.scene.labels;
  } else {
    choice.file = options.input.empty() ? options.volume : options.input;
    options.raw.applyTo(choice);
    options.labels.applyTo(labels);
  }
  prepared.source = openTogether(comm, choice);
  const node::VolumeInfo& info = prepared.source->info();
  prepared.facts = {info.grid, info.anatomical};
  if (labels.isGiven()) openLabels(comm, labels, prepared);
  if (!hasScene && prepared.labels)
    prepared.scene = sceneFromLabels(comm, options, choice, labels, prepared);
  else if (!hasScene)
    prepared.scene = sceneFromVolume(comm, options, choice, prepared);
  resolveLabels(comm, prepared);
  resolveScene(prepared.scene, prepared.facts);
  return prepared;
}

node::WorkerOptions workerOptions(const PreparedScene& prepared, node::WorkerOptions options) {
  options.labels = prepared.labels.get();
  options.survey = prepared.survey ? &*prepared.survey : nullptr;
  return options;
}

std::string sceneTextFor(const Scene& scene, const fs::path& target) {
  Scene moved = scene;
  const fs::path folder = fs::absolute(target).parent_path();
  for (std::string* name : {&moved.volume.file, &moved.labels.file, &moved.labels.names}) {
    const fs::path file = *name;
    if (!file.empty() && file.is_relative())
      *name = fs::proximate(fs::absolute(file), folder).string();
  }
  return writeScene(moved);
}

}  // namespace burin::host
