#include <cmath>
#include <memory>

#include "burin/common/error.hpp"
#include "options/describe.hpp"
#include "options/volume_input.hpp"

namespace burin::host {

namespace {

constexpr int kMostFrames = 1'000'000;

constexpr const char* kRenderFooter =
    R"(A file named .json is a scene, any other a volume, which is drawn with a scene made from its
histogram; --save-scene writes that scene down, to be edited. Volumes are NRRD, NIfTI, MetaImage, DICOM
(a folder), VTK (.vtk, .vti), HDF5 (file.h5:/path/of/dataset), TIFF stacks, numbered pictures
(slice%03d.png or their folder), or bare voxels (--dims and --type, unless the name says them).

--set takes the path of a key in the scene file and a JSON value, or a bare word:
  --set layers.0.style.tone.strength=0.5   --set quality.step_voxels=0.25
  --set camera.view=anterior               --set image.background=transparent
`burin styles` lists every style with its parameters; configs/schema.json has every key.

--labels takes a segmentation of the volume (3D Slicer's .seg.nrrd and label maps, ITK-SNAP, any readable
volume of whole numbers on the same grid): without a scene every label is drawn as a layer of its own,
in its colour if the file or --label-names says one; in a scene, "labels" of a layer says where it is.

--technique slices draws the same samples as Lum and Ma's hardware did, a plane, layer and pass at a
time. In float it is the same picture; --precision half and byte, and quality.combine "over" (each
draw over the one before), show what such hardware cost. Rays cannot end early: quality.termination
has no effect.

PNG is display-referred over the background; EXR is the float frame, premultiplied linear RGBA
without background. Both carry the scene, the program's version and the step.

On many ranks start with `mpirun --bind-to none`: Open MPI otherwise binds each to one core.)";

/// The options, and as words what is checked and translated when all are read.
struct Render {
  RenderOptions options;
  RawText raw;
  LabelText labels;
  std::string size;
  std::string skip = "on";
  std::string technique = "raycast";
  std::string precision = "float";
  std::string gl = "osmesa";
  std::string schedule = "auto";
  std::string wire = "float";
  std::string link = "auto";
  std::string zstd = "auto";
};

void addPictureOptions(OptionList& list, Render& render) {
  RenderOptions& options = render.options;
  list.path("-o,--output", options.output, "FILE.png|FILE.exr",
            "The picture, named after the input if not given");
  addVolume(list, options.volume);
  list.text("--size", render.size, "WxH", "Size of the picture");
  list.texts("--set", options.settings, "PATH=VALUE",
             "Change one key of the scene; may be repeated");
  list.integer("--frames", options.frames, 1, kMostFrames,
               "Draw N pictures along an orbit, out_0000.png …");
  list.number("--orbit", options.orbitDeg, "DEG",
              "Total sweep of the azimuth over all frames, 360 if not given")
      .needs("--frames");
  list.path("--save-scene", options.saveScene, "FILE", "Write the scene as it was drawn");
}

void addRunOptions(OptionList& list, Render& render) {
  RenderOptions& options = render.options;
  list.integer("--bricks", options.worker.bricks, 1, 1 << 20,
               "Bricks in all; one per drawing rank otherwise");
  list.choice("--skip", render.skip, {"on", "off"}, "Skip what provably cannot be seen (on)");
  list.flag("--dedicated-host", options.worker.dedicatedHost,
            "Rank 0 only collects and writes; needs two ranks or more");
  list.path("--stats", options.stats, "FILE.json",
            "Write times and counters of each frame and rank");
  list.path("--trace", options.trace, "FILE.json",
            "Write when each rank did what, for ui.perfetto.dev or chrome://tracing");
  list.flag("--count-samples", options.worker.countSamples, "Count samples for --stats (slower)")
      .needs("--stats");
  list.flag("--redraw", options.redraw,
            "Draw each frame anew though nothing changed since the one before, to time it")
      .needs("--frames");
  const Option reference = list.flag(
      "--reference", options.reference,
      "Draw with the slow double-precision reference; it has no bricks and skips nothing. With "
      "quality.max_error it has no steps either, but divides rays until they are that close");
  list.choice("--technique", render.technique, {"raycast", "slices"},
              "Fused rays, or slices: a draw for each sample plane, layer and pass (raycast)")
      .excludes(reference);
  list.choice("--precision", render.precision, {"float", "half", "byte"},
              "Of the framebuffer that slices are blended in: 32, 16 or 8 bits (float)");
  list.choice("--gl", render.gl, {"osmesa", "egl"},
              "Where OpenGL comes from; EGL finds graphics cards (osmesa)")
      .excludes(reference);
  list.flag("--quiet", options.quiet, "Say nothing but warnings and errors");
}

void addMergeOptions(OptionList& list, Render& render) {
  list.choice("--composite", render.schedule, {"auto", "swap", "radix-k", "direct", "serial"},
              "How ranks merge what they drew (auto)");
  list.choice("--wire", render.wire, {"float", "half"},
              "Pixels between ranks; half takes half the bytes and is off by up to 2^-10 for "
              "each time a pixel is sent (float)");
  list.choice("--link", render.link, {"auto", "fast", "slow"},
              "What joins the hosts: slow is Ethernet of 1 Gbit/s and less (auto: fast)");
  list.choice("--zstd", render.zstd, {"auto", "on", "off"},
              "Pack pixels that leave a host, without loss (auto: if the link is slow)");
}

MergeOptions mergeOptions(const Render& render) {
  using compositor::LinkClass;
  using compositor::Packing;
  using compositor::ScheduleKind;
  MergeOptions merge;
  for (const ScheduleKind kind : {ScheduleKind::kBinarySwap, ScheduleKind::kRadixK,
                                  ScheduleKind::kDirectSend, ScheduleKind::kSerialGather}) {
    if (render.schedule == compositor::scheduleName(kind)) {
      merge.composite.schedule = compositor::ScheduleOptions{.kind = kind};
    }
  }
  if (render.link == "fast") merge.composite.link = LinkClass::kFast;
  if (render.link == "slow") merge.composite.link = LinkClass::kSlow;
  if (render.zstd == "on") merge.composite.packing = Packing::kAlways;
  if (render.zstd == "off") merge.composite.packing = Packing::kNever;
  merge.isHalfOnWire = render.wire == "half";
  return merge;
}

void setTechnique(node::WorkerOptions& options, const Render& render) {
  if (render.technique == "slices") options.technique = node::Technique::kSlices;
  if (render.precision == "half") options.precision = node::Precision::kHalf;
  if (render.precision == "byte") options.precision = node::Precision::kByte;
  if (render.technique != "slices" && render.precision != "float")
    fail(ExitCode::kUsage, "--precision {} goes with --technique slices", render.precision);
}

/// "head.nii.gz" → "head.png".
std::filesystem::path defaultOutput(const std::filesystem::path& input) {
  std::filesystem::path name = input.filename();
  if (name.extension() == ".gz") name.replace_extension();
  return name.replace_extension(".png");
}

void checkOutput(const std::filesystem::path& output) {
  const auto extension = output.extension();
  if (extension != ".png" && extension != ".exr")
    fail(ExitCode::kUsage, "-o {}: expected a name that ends in .png or .exr", output.string());
}

RenderOptions finished(const Render& render, int ranks) {
  RenderOptions options = render.options;
  if (options.input.empty() && options.volume.empty())
    fail(ExitCode::kUsage, "render: expected a SCENE or a VOLUME");
  checkVolumeChoice(options.input, options.volume);
  if (!std::isfinite(options.orbitDeg))
    fail(ExitCode::kUsage, "--orbit {}: expected degrees", options.orbitDeg);
  if (options.worker.dedicatedHost && ranks == 1)
    fail(ExitCode::kUsage, "--dedicated-host needs two ranks or more, this run has one");
  if (options.output.empty())
    options.output = defaultOutput(options.input.empty() ? options.volume : options.input);
  checkOutput(options.output);
  if (!render.size.empty()) options.size = parseSize(render.size);
  options.raw = rawLayout(render.raw);
  options.labels = labelOptions(render.labels);
  options.worker.skip = render.skip == "on";
  setTechnique(options.worker, render);
  if (render.gl == "egl") options.worker.gl = node::GlBackend::kEgl;
  options.merge = mergeOptions(render);
  return options;
}

}  // namespace

Finish describeRender(OptionList& list) {
  const auto render = std::make_shared<Render>();
  addInput(list, render->options.input);
  addPictureOptions(list, *render);
  addRawOptions(list, render->raw);
  addLabelOptions(list, render->labels);
  addRunOptions(list, *render);
  addMergeOptions(list, *render);
  list.footer(kRenderFooter);
  return [render](int ranks) { return finished(*render, ranks); };
}

}  // namespace burin::host
