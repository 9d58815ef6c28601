#include <memory>
#include <sstream>

#include "burin/common/error.hpp"
#include "options/describe.hpp"
#include "options/volume_input.hpp"

namespace burin::host {

namespace {

constexpr ImageSize kPanel{256, 256};
constexpr int kMostColumns = 100;

constexpr const char* kGalleryFooter =
    R"(Of one INPUT: every named style (burin styles) on every layer of the scene, with its name below, to
choose by looking. Then:
  burin render INPUT --set layers.0.style=NAME -o picture.png      (and layers.1.style=NAME, …)
Of several: each as burin render draws it, without annotations; its title or else its name is below.)";

struct Gallery {
  GalleryOptions options;
  RawText raw;
  LabelText labels;
  std::string size;
  std::string styles;
};

/// The names between commas.
std::vector<std::string> names(const std::string& list) {
  std::vector<std::string> found;
  std::istringstream in{list};
  for (std::string name; std::getline(in, name, ',');) found.push_back(name);
  return found;
}

GalleryOptions finished(const Gallery& gallery, int ranks) {
  GalleryOptions options = gallery.options;
  RenderOptions& render = options.render;
  if (options.inputs.empty() && render.volume.empty())
    fail(ExitCode::kUsage, "gallery: expected a SCENE or a VOLUME");
  for (const std::string& input : options.inputs) checkVolumeChoice(input, render.volume);
  if (options.inputs.size() > 1 && !gallery.styles.empty())
    fail(ExitCode::kUsage, "--styles goes with one INPUT, here are {}", options.inputs.size());
  if (options.inputs.size() == 1) render.input = options.inputs.front();
  if (render.worker.dedicatedHost && ranks == 1)
    fail(ExitCode::kUsage, "--dedicated-host needs two ranks or more, this run has one");
  if (render.output.extension() != ".png")
    fail(ExitCode::kUsage, "-o {}: expected a name that ends in .png", render.output.string());
  render.size = gallery.size.empty() ? kPanel : parseSize(gallery.size);
  render.raw = rawLayout(gallery.raw);
  render.labels = labelOptions(gallery.labels);
  options.styles = names(gallery.styles);
  return options;
}

}  // namespace

Finish describeGallery(OptionList& list) {
  const auto gallery = std::make_shared<Gallery>();
  RenderOptions& render = gallery->options.render;
  list.positionals("INPUT", gallery->options.inputs, "FILE", "Scenes (.json) and volumes");
  list.path("-o,--output", render.output, "FILE.png", "The sheet").required();
  addVolume(list, render.volume);
  list.text("--styles", gallery->styles, "NAME,NAME,…", "Only these, in this order (all)");
  list.integer("--columns", gallery->options.columns, 1, kMostColumns,
               "Panels in a row (about as many as rows)");
  list.text("--size", gallery->size, "WxH", "Size of a panel (256x256)");
  list.texts("--set", render.settings, "PATH=VALUE",
             "Change one key of the scene; may be repeated");
  addRawOptions(list, gallery->raw);
  addLabelOptions(list, gallery->labels);
  list.integer("--bricks", render.worker.bricks, 1, 1 << 20,
               "Bricks in all; one per drawing rank otherwise");
  list.flag("--dedicated-host", render.worker.dedicatedHost,
            "Rank 0 only collects and writes; needs two ranks or more");
  list.flag("--quiet", render.quiet, "Say nothing but warnings and errors");
  list.footer(kGalleryFooter);
  return [gallery](int ranks) { return finished(*gallery, ranks); };
}

}  // namespace burin::host
