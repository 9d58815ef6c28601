#include "burin/host/display.hpp"

#include "burin/common/combine_name.hpp"
#include "burin/common/error.hpp"
#include "burin/common/temporary_file.hpp"
#include "burin/host/annotate.hpp"
#include "burin/host/scene_setup.hpp"

namespace burin::host {

namespace fs = std::filesystem;

fs::path frameFile(const RenderOptions& options, int index) {
  if (options.frames == 0) return options.output;
  fs::path file = options.output;
  return file.replace_filename(fmt::format("{}_{:04}{}", options.output.stem().string(), index,
                                           options.output.extension().string()));
}

namespace {

/// A file and what the user knows it as.
struct NamedFile {
  std::string_view role;
  fs::path path;
};

/// One name for a file, whether or not it exists and however it is spelled.
fs::path uniqueName(const fs::path& file) {
  std::error_code error;
  const fs::path absolute = fs::absolute(file, error);
  const fs::path unique = fs::weakly_canonical(absolute, error);
  return error ? absolute.lexically_normal() : unique;
}

bool areSame(const NamedFile& a, const NamedFile& b) {
  return !a.path.empty() && !b.path.empty() && uniqueName(a.path) == uniqueName(b.path);
}

constexpr std::string_view kSaveScene = "--save-scene";
constexpr std::string_view kTheScene = "the scene";

}  // namespace

void checkConflicts(const RenderOptions& options, const fs::path& volume, const fs::path& labels) {
  const NamedFile outputs[] = {{"-o", frameFile(options, 0)},
                               {"--stats", options.stats},
                               {"--trace", options.trace},
                               {kSaveScene, options.saveScene}};
  const NamedFile inputs[] = {{kTheScene, isSceneFile(options.input) ? options.input : ""},
                              {"the volume", volume},
                              {"the labels", labels}};
  for (const NamedFile& output : outputs) {
    for (const NamedFile& input : inputs) {
      const bool allowed = output.role == kSaveScene && input.role == kTheScene;
      if (!allowed && areSame(output, input))
        fail(ExitCode::kUsage, "{} {}: this would overwrite {} {}", output.role,
             output.path.string(), input.role, input.path.string());
    }
    for (const NamedFile* other = outputs; other != &output; ++other) {
      if (areSame(output, *other))
        fail(ExitCode::kUsage, "{} {} and {} {} are the same file", other->role,
             other->path.string(), output.role, output.path.string());
    }
  }
}

void checkOutputs(const RenderOptions& options) {
  const bool volumeGiven = !options.input.empty() && !isSceneFile(options.input);
  checkConflicts(options, volumeGiven ? options.input : options.volume, options.labels.file);
  checkWritable(frameFile(options, 0));
  if (!options.stats.empty()) checkWritable(options.stats);
  if (!options.trace.empty()) checkWritable(options.trace);
  if (options.saveScene.empty()) return;
  if (!isSceneFile(options.saveScene))
    fail(ExitCode::kUsage, "{} {}: expected a name that ends in .json", kSaveScene,
         options.saveScene.string());
  checkWritable(options.saveScene);
}

PictureMetadata metadataFor(const Scene& scene, const RenderOptions& options,
                            const fs::path& target, double orbitDeg) {
  const Quality& quality = scene.quality;
  PictureMetadata metadata;
  metadata.scene = sceneTextFor(scene, target);
  if (!quality.maxError) metadata.stepVoxels = quality.stepVoxels;
  metadata.orbitDeg = orbitDeg;
  metadata.technique = options.reference ? "reference" : name(options.worker.technique);
  metadata.precision = options.reference ? "double" : name(options.worker.precision);
  metadata.combine = name(quality.combine);
  return metadata;
}

Display::Display(const PreparedScene& prepared, const RenderOptions& options)
    : prepared_{prepared}, options_{options} {
  if (prepared.scene.annotations.any() && !isExr()) checkFont();
}

bool Display::isExr() const {
  return options_.output.extension() == ".exr";
}

void Display::finish(ImageView<const Rgba> frame, const Camera& camera) {
  frame_ = frame;
  if (isExr()) return;
  picture_ = toDisplay(frame_, prepared_.scene.background);
  annotate(picture_, frame_, prepared_.scene, prepared_.facts, camera);
}

void Display::write(int index, double orbitDeg) const {
  const fs::path target = frameFile(options_, index);
  const PictureMetadata metadata = metadataFor(prepared_.scene, options_, target, orbitDeg);
  if (isExr()) {
    writeExr(target, frame_, metadata);
  } else {
    writePng(target, picture_, metadata);
  }
}

}  // namespace burin::host
