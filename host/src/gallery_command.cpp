#include <algorithm>
#include <optional>

#include "burin/common/error.hpp"
#include "burin/common/log.hpp"
#include "burin/common/named_style.hpp"
#include "burin/common/nearest_name.hpp"
#include "burin/common/temporary_file.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/display.hpp"
#include "burin/host/frame_maker.hpp"
#include "burin/host/interrupt.hpp"
#include "burin/host/progress.hpp"
#include "burin/host/scene_setup.hpp"
#include "burin/host/shared_error.hpp"
#include "contact_sheet.hpp"
#include "picture_need.hpp"

namespace burin::host {

namespace fs = std::filesystem;

namespace {

/// The named styles that are asked for, in that order; all of them if none is.
std::vector<NamedStyle> chosenStyles(const std::vector<std::string>& names) {
  const std::vector<NamedStyle> known = findNamedStyles(styleFolders());
  if (known.empty()) fail(ExitCode::kUsage, "no folder of styles is found (BURIN_STYLES)");
  if (names.empty()) return known;
  std::vector<NamedStyle> chosen;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(known, name, &NamedStyle::name);
    if (found == known.end()) {
      std::vector<std::string_view> knownNames;
      for (const NamedStyle& style : known) knownNames.push_back(style.name);
      fail(ExitCode::kUsage, "--styles: '{}' is unknown; {}", name,
           nameSuggestion(name, knownNames));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

/// The scene with a style on every layer that can have one, less the effects that a layer cannot
/// have. How gradients are made stays the layer's own business unless the style says it.
Scene inStyle(Scene scene, const NamedStyle& style) {
  constexpr std::string_view kGradient = "gradient";
  constexpr std::string_view kHalo = "halo";
  for (Layer& layer : scene.layers) {
    if (isProjection(layer.mode)) continue;
    const StyleSettings* own = layer.style(kGradient);
    const bool isSaid =
        std::ranges::find(style.effects, kGradient, &StyleSettings::name) != style.effects.end();
    std::vector<StyleSettings> effects = style.effects;
    if (own != nullptr && !isSaid) effects.insert(effects.begin(), *own);
    if (!canHaveHalo(layer) && std::erase_if(effects, [&](const StyleSettings& effect) {
                                 return effect.name == kHalo;
                               }) > 0)
      note(
          "style {}: layer {} is drawn without its halo, which lies around a medium of values "
          "alone",
          style.name, layer.name.empty() ? "without a name" : fmt::format("\"{}\"", layer.name));
    layer.styles = std::move(effects);
  }
  return scene;
}

/// What a sheet takes, of which one panel at a time is a picture.
MemoryNeed sheetNeed(const Communicator& comm, const SheetLayout& layout) {
  MemoryNeed need = pictureNeed(comm, layout.panel);
  if (!comm.isRoot()) return need;
  need.bytes += static_cast<std::int64_t>(3 * layout.size.pixels());
  need.purpose = fmt::format("a sheet of {}x{} pixels", layout.size.width, layout.size.height);
  return need;
}

/// The loop over the panels, on all ranks; rank 0 has the sheet besides. A panel is a style of the
/// one input, or one of several inputs.
class Gallery {
 public:
  Gallery(const Communicator& comm, const GalleryOptions& options)
      : comm_{comm},
        options_{options},
        hasInputs_{options.inputs.size() > 1},
        progress_{comm.isRoot() && !options.render.quiet} {
    onRoot(comm_, [&] { deferInterrupts([&] { checkOutputs(options_.render); }); });
    if (hasInputs_) {
      count_ = static_cast<int>(options_.inputs.size());
    } else {
      onRoot(comm_, [&] { styles_ = chosenStyles(options_.styles); });
      progress_.show("reading the volume");
      prepared_ = prepareScene(comm_, options_.render);
      onRoot(comm_, [&] {
        checkConflicts(options_.render, prepared_.scene.volume.file, prepared_.scene.labels.file);
      });
      makeScenes();
    }
    SheetLayout layout;
    onRoot(comm_, [&] {
      loadPictureEncoder();
      layout = layOutSheet(*options_.render.size, count_,
                           options_.columns > 0 ? options_.columns : squareColumns(count_),
                           hasInputs_ ? kTitleLines : 1);
    });
    checkMemory(comm_, sheetNeed(comm_, layout));
    if (comm_.isRoot()) sheet_.emplace(layout);
  }

  int run() {
    const InterruptWatch watch;
    for (int i = 0; i < count_; ++i) {
      progress_.show(fmt::format("panel {} of {}", i + 1, count_));
      if (const int signal = drawPanel(i); signal != 0) {
        progress_.clear();
        if (comm_.isRoot()) note("stopped by signal {}", signal);
        return kSignalExitBase + signal;
      }
    }
    progress_.clear();
    onRoot(comm_, [&] { write(); });
    return static_cast<int>(ExitCode::kDone);
  }

 private:
  static constexpr int kTitleLines = 3;

  /// Collective. The input in every style.
  void makeScenes() {
    unstyled_ = prepared_.scene;
    std::int64_t count = static_cast<std::int64_t>(styles_.size());
    allReduce(comm_, std::span{&count, 1}, MPI_MAX);
    count_ = static_cast<int>(count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(count_); ++i) {
      std::string text;
      onRoot(comm_, [&] { text = writeScene(inStyle(unstyled_, styles_[i])); });
      text = broadcastText(comm_, std::move(text), Rank{0});
      together(comm_, "the style", [&] { scenes_.push_back(parseScene(text, "gallery")); });
    }
  }

  /// The signal that some rank got, or 0.
  int drawPanel(int index) {
    const std::string label = hasInputs_ ? showInput(index) : showStyle(index);
    const Scene& scene = prepared_.scene;
    RankStatistics statistics{};
    const ImageView<const Rgba> frame =
        frames_->make(resolveCamera(scene, prepared_.facts), statistics);
    onRoot(comm_, [&] {
      sheet_->place(index, toDisplay(frame, scene.background.value_or(Colour{255, 255, 255})),
                    label);
    });
    std::int64_t signal = interruptSignal();
    allReduce(comm_, std::span{&signal, 1}, MPI_MAX);
    return static_cast<int>(signal);
  }

  /// Draws the scene in that style from now on; returns its label (of rank 0).
  std::string showStyle(int index) {
    prepared_.scene = scenes_[static_cast<std::size_t>(index)];
    showScene();
    return comm_.isRoot() ? styles_[static_cast<std::size_t>(index)].name : "";
  }

  /// Draws that input from now on; returns its label.
  std::string showInput(int index) {
    RenderOptions render = options_.render;
    render.input = options_.inputs[static_cast<std::size_t>(index)];
    PreparedScene next = prepareScene(comm_, render);
    onRoot(comm_, [&] { checkConflicts(render, next.scene.volume.file, next.scene.labels.file); });
    const fs::path input = render.input.empty() ? render.volume : render.input;
    const std::string label = next.scene.annotations.title.value_or(input.stem().string());
    if (frames_ && next.scene.volume == prepared_.scene.volume &&
        next.scene.labels == prepared_.scene.labels) {
      prepared_.scene = next.scene;
    } else {
      frames_.reset();
      prepared_ = std::move(next);
    }
    showScene();
    return label;
  }

  /// A volume is loaded for its first panel; the others change what they must.
  void showScene() {
    if (frames_) return frames_->update(prepared_.scene);
    node::WorkerOptions worker = options_.render.worker;
    worker.views = {resolveCamera(prepared_.scene, prepared_.facts)};
    worker.foreseen = scenes_;
    frames_ = makeRaycastFrames(comm_, prepared_, worker, options_.render.merge);
  }

  void write() const {
    const fs::path& target = options_.render.output;
    PictureMetadata metadata =
        metadataFor(hasInputs_ ? Scene{} : unstyled_, options_.render, target, 0);
    if (hasInputs_) {  // each has its own
      metadata.scene.clear();
      metadata.stepVoxels.reset();
    }
    writePng(target, sheet_->picture(), metadata);
    note("{}: {} {}, {} x {}", target.string(), count_, hasInputs_ ? "scenes" : "styles",
         sheet_->picture().size.width, sheet_->picture().size.height);
  }

  const Communicator& comm_;
  const GalleryOptions& options_;
  bool hasInputs_;
  Progress progress_;
  int count_ = 0;
  std::vector<NamedStyle> styles_;  ///< on rank 0
  std::vector<Scene> scenes_;       ///< the one input's, one for each style
  Scene unstyled_;                  ///< the one input's
  PreparedScene prepared_;          ///< of the panel that is drawn
  std::unique_ptr<FrameMaker> frames_;
  std::optional<ContactSheet> sheet_;  ///< on rank 0
};

}  // namespace

int runCommand(const Communicator& comm, const GalleryOptions& options) {
  setQuiet(options.render.quiet);
  Gallery gallery{comm, options};
  return gallery.run();
}

}  // namespace burin::host
