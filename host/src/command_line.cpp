#include "burin/host/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "burin/common/error.hpp"
#include "burin/common/nearest_name.hpp"
#include "help_texts.hpp"

namespace burin::host {

namespace {

constexpr int kMostFrames = 1'000'000;

/// What CLI11 fills in before it is checked.
struct RawText {
  std::string dims, type, endian, spacing;
};
struct RenderText {
  RawText raw;
  std::string size;
  std::string skip = "on";
  std::string technique = "raycast";
  std::string precision = "float";
  std::string schedule = "auto";
  std::string wire = "float";
  std::string link = "auto";
  std::string zstd = "auto";
  CLI::Option* orbit = nullptr;
};
struct MakeText {
  std::string dims, spacing;
};
struct BenchText {
  CLI::Option* repeats = nullptr;
};

void addRawOptions(CLI::App& app, RawText& text) {
  app.add_option("--dims", text.dims, "Voxels along each axis of a bare raw file")
      ->type_name("X,Y,Z");
  app.add_option("--type", text.type, "Type of its voxels")
      ->type_name("TYPE")
      ->check(CLI::IsMember({"u8", "i16", "u16", "f32"}));
  app.add_option("--endian", text.endian, "Byte order of its voxels")
      ->type_name("ORDER")
      ->check(CLI::IsMember({"little", "big"}));
  app.add_option("--spacing", text.spacing, "Distance of its voxels in world units")
      ->type_name("X,Y,Z");
}

RawLayout rawLayout(const RawText& text) {
  RawLayout raw;
  if (!text.dims.empty()) raw.dims = parseDims(text.dims, "--dims");
  if (!text.type.empty()) raw.type = text.type;
  if (!text.endian.empty()) raw.endian = text.endian;
  if (!text.spacing.empty()) raw.spacing = parseSpacing(text.spacing, "--spacing");
  return raw;
}

void addPictureOptions(CLI::App& app, RenderOptions& options, RenderText& text) {
  app.add_option("-o,--output", options.output, "The picture, named after the input if not given")
      ->type_name("FILE.png|FILE.exr");
  app.add_option("--volume", options.volume, "Draw this volume, whatever the scene names")
      ->type_name("FILE");
  app.add_option("--size", text.size, "Size of the picture")->type_name("WxH");
  app.add_option("--set", options.settings, "Change one key of the scene; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  app.add_option("--frames", options.frames, "Draw N pictures along an orbit, out_0000.png …")
      ->type_name("N")
      ->check(CLI::Range(1, kMostFrames));
  text.orbit = app.add_option("--orbit", options.orbitDeg,
                              "Total sweep of the azimuth over all frames, 360 if not given")
                   ->type_name("DEG")
                   ->needs("--frames");
  app.add_option("--save-scene", options.saveScene, "Write the scene as it was drawn")
      ->type_name("FILE");
}

void addRunOptions(CLI::App& app, RenderOptions& options, RenderText& text) {
  app.add_option("--bricks", options.worker.bricks, "Bricks in all; one per drawing rank otherwise")
      ->type_name("N")
      ->check(CLI::Range(1, 1 << 20));
  app.add_option("--skip", text.skip, "Skip what provably cannot be seen (on)")
      ->type_name("on|off")
      ->check(CLI::IsMember({"on", "off"}));
  app.add_flag("--dedicated-host", options.worker.dedicatedHost,
               "Rank 0 only collects and writes; needs two ranks or more");
  app.add_option("--stats", options.stats, "Write times and counters of each frame and rank")
      ->type_name("FILE.json");
  app.add_flag("--count-samples", options.worker.countSamples, "Count samples for --stats (slower)")
      ->needs("--stats");
  app.add_flag("--redraw", options.redraw,
               "Draw each frame anew though nothing changed since the one before, to time it")
      ->needs("--frames");
  CLI::Option* const reference = app.add_flag(
      "--reference", options.reference,
      "Draw with the slow double-precision reference; it has no bricks and skips nothing");
  app.add_option("--technique", text.technique,
                 "Fused rays, or slices: a draw for each sample plane, layer and pass (raycast)")
      ->type_name("raycast|slices")
      ->check(CLI::IsMember({"raycast", "slices"}))
      ->excludes(reference);
  app.add_option("--precision", text.precision,
                 "Of the framebuffer that slices are blended in: 32, 16 or 8 bits (float)")
      ->type_name("float|half|byte")
      ->check(CLI::IsMember({"float", "half", "byte"}));
  app.add_flag("--quiet", options.quiet, "Say nothing but warnings and errors");
}

void addMergeOptions(CLI::App& app, RenderText& text) {
  app.add_option("--composite", text.schedule, "How ranks merge what they drew (auto)")
      ->type_name("auto|swap|radix-k|direct|serial")
      ->check(CLI::IsMember({"auto", "swap", "radix-k", "direct", "serial"}));
  app.add_option("--wire", text.wire,
                 "Pixels between ranks; half takes half the bytes and is off by up to 2^-10 for "
                 "each time a pixel is sent (float)")
      ->type_name("float|half")
      ->check(CLI::IsMember({"float", "half"}));
  app.add_option("--link", text.link,
                 "What joins the hosts: slow is Ethernet of 1 Gbit/s and less (auto: fast)")
      ->type_name("auto|fast|slow")
      ->check(CLI::IsMember({"auto", "fast", "slow"}));
  app.add_option("--zstd", text.zstd,
                 "Pack pixels that leave a host, without loss (auto: if the link is slow)")
      ->type_name("auto|on|off")
      ->check(CLI::IsMember({"auto", "on", "off"}));
}

MergeOptions mergeOptions(const RenderText& text) {
  using compositor::LinkClass;
  using compositor::Packing;
  using compositor::ScheduleKind;
  MergeOptions merge;
  for (const ScheduleKind kind : {ScheduleKind::kBinarySwap, ScheduleKind::kRadixK,
                                  ScheduleKind::kDirectSend, ScheduleKind::kSerialGather}) {
    if (text.schedule == compositor::scheduleName(kind)) {
      merge.composite.schedule = compositor::ScheduleOptions{.kind = kind};
    }
  }
  if (text.link == "fast") merge.composite.link = LinkClass::kFast;
  if (text.link == "slow") merge.composite.link = LinkClass::kSlow;
  if (text.zstd == "on") merge.composite.packing = Packing::kAlways;
  if (text.zstd == "off") merge.composite.packing = Packing::kNever;
  merge.isHalfOnWire = text.wire == "half";
  return merge;
}

void setTechnique(node::WorkerOptions& options, const RenderText& text) {
  if (text.technique == "slices") options.technique = node::Technique::kSlices;
  if (text.precision == "half") options.precision = node::Precision::kHalf;
  if (text.precision == "byte") options.precision = node::Precision::kByte;
  if (text.technique != "slices" && text.precision != "float")
    fail(ExitCode::kUsage, "--precision {} goes with --technique slices", text.precision);
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

/// "--volume" beside a volume would leave open which of them is meant.
void checkVolumeChoice(const std::string& input, const std::string& volume) {
  if (!input.empty() && !volume.empty() && !isSceneFile(input))
    fail(ExitCode::kUsage, "--volume goes with a scene (a .json file), not with volume {}", input);
}

RenderOptions finished(RenderOptions options, const RenderText& text, int ranks) {
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
  if (!text.size.empty()) options.size = parseSize(text.size);
  options.raw = rawLayout(text.raw);
  options.worker.skip = text.skip == "on";
  setTechnique(options.worker, text);
  options.merge = mergeOptions(text);
  return options;
}

MakeVolumeOptions finished(MakeVolumeOptions options, const MakeText& text) {
  options.dims = parseDims(text.dims, "--dims");
  if (!text.spacing.empty()) options.spacing = parseSpacing(text.spacing, "--spacing");
  return options;
}

void describeMakeVolume(CLI::App& app, MakeVolumeOptions& options, MakeText& text) {
  app.add_option("KIND", options.kind, "What to make, see below")->required();
  app.add_option("--dims", text.dims, "Voxels along each axis")->type_name("X,Y,Z")->required();
  app.add_option("--type", options.type, "Type of the voxels (u8)")
      ->type_name("TYPE")
      ->check(CLI::IsMember({"u8", "i16", "u16", "f32"}));
  app.add_option("--spacing", text.spacing, "Distance of voxels in world units (1,1,1)")
      ->type_name("X,Y,Z");
  app.add_option("-o,--output", options.output, "The file to write")->type_name("FILE")->required();
  app.footer(makeVolumeFooter());
}

/// What all benchmarks take.
template <typename Options>
void addBenchOptions(CLI::App& app, Options& options) {
  app.add_option("INPUT", options.input, "A scene (.json) or a volume")->type_name("FILE");
  app.add_option("--volume", options.volume, "Draw this volume, whatever the scene names")
      ->type_name("FILE");
  app.add_option("--out", options.folder, "Where the table and the plots go (bench)")
      ->type_name("DIR");
}

BenchText describeBenchCompositing(CLI::App& app, BenchCompositingOptions& options) {
  BenchText text;
  addBenchOptions(app, options);
  app.add_flag("--quick", options.quick, "512x512 and 3 repeats, no discs");
  app.add_option("--ranks", options.ranks, "Rank counts (2 to 8, and all)")
      ->type_name("N,N,…")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--sizes", options.sides, "Sides of the square frames (512,1024,2048)")
      ->type_name("N,N,…")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(1, kLargestImageSide));
  text.repeats =
      app.add_option("--repeats", options.repeats, "Times of which the median is taken (9)")
          ->type_name("N")
          ->check(CLI::Range(1, 10'000));
  app.add_flag("--dedicated-host", options.dedicatedHost, "Rank 0 draws nothing");
  app.add_option("--network", options.network,
                 "What the table calls the network (shm if all ranks share memory)")
      ->type_name("NAME");
  app.footer(benchCompositingFooter());
  return text;
}

/// Returns --size.
CLI::Option* describeBenchScaling(CLI::App& app, BenchScalingOptions& options) {
  addBenchOptions(app, options);
  app.add_flag("--quick", options.quick, "64x64x64 voxels, up to 32 ranks");
  app.add_option("--bricks", options.bricks,
                 "Numbers of ranks whose bricks are drawn one by one (1,2,4,…,256)")
      ->type_name("N,N,…")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(1, 4096));
  app.add_option("--repeats", options.repeats, "Times of which the median is taken (3)")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000));
  app.footer(benchScalingFooter());
  return app
      .add_option("--size", options.side,
                  "Voxels along each axis of the built-in volume (256); twice as many for Lum and "
                  "Ma's, a quarter for each rank of weak scaling")
      ->type_name("N")
      ->check(CLI::Range(16, 512));
}

/// Returns --size.
CLI::Option* describeBenchSkip(CLI::App& app, BenchSkipOptions& options) {
  addBenchOptions(app, options);
  app.add_flag("--quick", options.quick, "96x96x96 voxels and fewer fractions");
  app.add_option("--repeats", options.repeats, "Times of which the median is taken (5)")
      ->type_name("N")
      ->check(CLI::Range(5, 10'000));
  app.footer(benchSkipFooter());
  return app
      .add_option(
          "--size", options.side,
          "Voxels along each axis of the built-in volumes (256); the frame is twice as wide")
      ->type_name("N")
      ->check(CLI::Range(16, 1024));
}

/// Returns --size.
CLI::Option* describeBenchAccuracy(CLI::App& app, BenchAccuracyOptions& options) {
  addBenchOptions(app, options);
  app.add_flag("--quick", options.quick, "Frames of 96x96 pixels, a coarser reference");
  app.add_option("--repeats", options.repeats, "Times of which the median is taken (5)")
      ->type_name("N")
      ->check(CLI::Range(5, 10'000));
  app.footer(benchAccuracyFooter());
  return app.add_option("--size", options.side, "Side of the square frames (256)")
      ->type_name("N")
      ->check(CLI::Range(1, kLargestImageSide));
}

/// Returns --size.
CLI::Option* describeBenchMaxError(CLI::App& app, BenchMaxErrorOptions& options) {
  app.add_option("VOLUME", options.volumes, "Volumes (the procedural kinds)")->type_name("FILE");
  app.add_option("--out", options.folder, "Where the table goes (bench)")->type_name("DIR");
  app.add_flag("--quick", options.quick, "Frames of 64x64 pixels, one view");
  app.add_option("--smallest-step", options.smallestStep,
                 "Smallest fixed step to compare with, voxels (1/64)")
      ->type_name("X")
      ->check(CLI::Range(kSmallestStepVoxels, kLargestChosenStep));
  app.footer(benchMaxErrorFooter());
  return app.add_option("--size", options.side, "Side of the square frames (128)")
      ->type_name("N")
      ->check(CLI::Range(1, kLargestImageSide));
}

BenchMaxErrorOptions finished(BenchMaxErrorOptions options, const CLI::Option& size) {
  if (options.quick && size.empty()) options.side = 64;
  return options;
}

BenchAccuracyOptions finished(BenchAccuracyOptions options, const CLI::Option& size) {
  checkVolumeChoice(options.input, options.volume);
  if (options.quick && size.empty()) options.side = 96;
  return options;
}

/// INPUT and --volume, and that --size is not given beside them.
template <typename Options>
void checkBenchInput(const Options& options, const CLI::Option& size) {
  checkVolumeChoice(options.input, options.volume);
  const bool isBuiltIn = options.input.empty() && options.volume.empty();
  if (!isBuiltIn && !size.empty())
    fail(ExitCode::kUsage, "--size {} goes with the built-in volumes, not with a scene or volume",
         options.side);
}

BenchSkipOptions finished(BenchSkipOptions options, const CLI::Option& size) {
  checkBenchInput(options, size);
  if (options.quick && size.empty()) options.side = 96;
  return options;
}

void sortUnique(std::vector<int>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

BenchScalingOptions finished(BenchScalingOptions options, const CLI::Option& size) {
  checkBenchInput(options, size);
  if (options.quick && size.empty()) options.side = 64;
  if (options.bricks.empty()) {
    for (int ranks = 1; ranks <= (options.quick ? 32 : 256); ranks *= 2)
      options.bricks.push_back(ranks);
  }
  sortUnique(options.bricks);
  return options;
}

BenchCompositingOptions finished(BenchCompositingOptions options, const BenchText& text,
                                 int ranks) {
  if (ranks < 2)
    fail(ExitCode::kUsage, "bench compositing needs two ranks or more, this run has one");
  checkVolumeChoice(options.input, options.volume);
  if (options.network.find_first_of(",\"\r\n") != std::string::npos)
    fail(ExitCode::kUsage, "--network {}: expected a name without commas, quotes or line ends",
         options.network);
  for (const int wanted : options.ranks) {
    if (wanted < 2 || wanted > ranks)
      fail(ExitCode::kUsage, "--ranks {}: expected 2 to {}, as many as this run has", wanted,
           ranks);
  }
  if (options.ranks.empty()) {
    for (int some = 2; some <= std::min(ranks, 8); ++some) options.ranks.push_back(some);
    options.ranks.push_back(ranks);
  }
  if (options.sides.empty())
    options.sides = options.quick ? std::vector{512} : std::vector{512, 1024, 2048};
  sortUnique(options.ranks);
  sortUnique(options.sides);
  if (options.quick && text.repeats->empty()) options.repeats = 3;
  return options;
}

constexpr std::string_view kCommands[] = {"render", "info", "make-volume", "styles", "bench"};

/// CLI11 would only say that a subcommand is missing.
void checkCommandName(std::span<const char* const> arguments) {
  if (arguments.empty())
    fail(ExitCode::kUsage, "expected a command: {} (burin --help tells more)",
         fmt::join(kCommands, ", "));
  const std::string_view name = arguments.front();
  if (name == "-h" || name == "--help" || name == "--version") return;
  if (std::ranges::find(kCommands, name) != std::end(kCommands)) return;
  fail(ExitCode::kUsage, "unknown command '{}': {}", name, nameSuggestion(name, kCommands));
}

/// "--size is given twice" for an option that takes one value and got more; else "".
std::string givenTwice(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::size_t given = option->results().size();
    if (option->get_items_expected_max() != 1 || given < 2) continue;
    const std::string times = given == 2 ? "twice" : fmt::format("{} times", given);
    return fmt::format("{} is given {}", option->get_name(), times);
  }
  return {};
}

/// CLI11's own words on one line, with where to read more.
[[noreturn]] void failUsage(const CLI::App& app, const CLI::ParseError& error) {
  std::string message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  const auto chosen = app.get_subcommands();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr && !chosen.empty()) {
    const std::string twice = givenTwice(*chosen.front());
    if (!twice.empty()) message = twice;
  }
  const std::string program = chosen.empty() ? "burin" : "burin " + chosen.front()->get_name();
  fail(ExitCode::kUsage, "{} ({} --help lists the options)", message, program);
}

/// Arguments in the order CLI11 wants: last one first.
std::vector<std::string> reversed(std::span<const char* const> arguments) {
  return {arguments.rbegin(), arguments.rend()};
}

}  // namespace

void RawLayout::applyTo(VolumeChoice& choice) const {
  if (dims) choice.dims = dims;
  if (type) choice.type = type;
  if (endian) choice.endian = endian;
  if (spacing) choice.spacing = spacing;
}

bool isSceneFile(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".json" || extension == ".jsonc";
}

const char* programVersion() {
  return BURIN_VERSION;
}

Command parseCommandLine(std::span<const char* const> arguments, int ranks) {
  checkCommandName(arguments);
  CLI::App app{"burin draws illustrations of volume data, on any number of MPI ranks.", "burin"};
  app.set_version_flag("--version", std::string{"burin "} + programVersion());
  app.footer(programFooter());
  app.require_subcommand(1);

  RenderOptions render;
  RenderText renderText;
  CLI::App& renderApp = *app.add_subcommand("render", "Draw a scene or a volume");
  renderApp.add_option("INPUT", render.input, "A scene (.json) or a volume")->type_name("FILE");
  addPictureOptions(renderApp, render, renderText);
  addRawOptions(renderApp, renderText.raw);
  addRunOptions(renderApp, render, renderText);
  addMergeOptions(renderApp, renderText);
  renderApp.footer(renderFooter());

  InfoOptions info;
  RawText infoText;
  CLI::App& infoApp = *app.add_subcommand("info", "Describe a volume");
  infoApp.add_option("VOLUME", info.volume, "The volume")->type_name("FILE")->required();
  addRawOptions(infoApp, infoText);

  MakeVolumeOptions make;
  MakeText makeText;
  CLI::App& makeApp = *app.add_subcommand("make-volume", "Write a procedural volume");
  describeMakeVolume(makeApp, make, makeText);

  CLI::App& stylesApp = *app.add_subcommand("styles", "List the styles and their parameters");

  BenchCompositingOptions compositing;
  CLI::App& benchApp = *app.add_subcommand("bench", "Measure burin");
  benchApp.require_subcommand(1);
  CLI::App& compositingApp =
      *benchApp.add_subcommand("compositing", "Merging subimages, against IceT");
  const BenchText benchText = describeBenchCompositing(compositingApp, compositing);
  BenchAccuracyOptions accuracy;
  CLI::App& accuracyApp = *benchApp.add_subcommand("accuracy", "Error against time and samples");
  const CLI::Option* const accuracySize = describeBenchAccuracy(accuracyApp, accuracy);
  BenchMaxErrorOptions maxError;
  CLI::App& maxErrorApp =
      *benchApp.add_subcommand("max-error", "Whether quality.max_error is kept, and at what cost");
  const CLI::Option* const maxErrorSize = describeBenchMaxError(maxErrorApp, maxError);

  BenchSkipOptions skip;
  CLI::App& skipApp = *benchApp.add_subcommand("skip", "Skipping empty space, on and off");
  const CLI::Option* const skipSize = describeBenchSkip(skipApp, skip);
  BenchScalingOptions scaling;
  CLI::App& scalingApp = *benchApp.add_subcommand("scaling", "Frames on ever more ranks");
  const CLI::Option* const scalingSize = describeBenchScaling(scalingApp, scaling);

  try {
    app.parse(reversed(arguments));
  } catch (const CLI::Success& wanted) {  // --help or --version
    std::ostringstream out, unused;
    app.exit(wanted, out, unused);
    return Answer{out.str()};
  } catch (const CLI::ParseError& error) {
    failUsage(app, error);
  }
  if (renderApp.parsed()) return finished(render, renderText, ranks);
  if (makeApp.parsed()) return finished(make, makeText);
  if (compositingApp.parsed()) return finished(compositing, benchText, ranks);
  if (skipApp.parsed()) return finished(skip, *skipSize);
  if (accuracyApp.parsed()) return finished(accuracy, *accuracySize);
  if (maxErrorApp.parsed()) return finished(maxError, *maxErrorSize);
  if (scalingApp.parsed()) return finished(scaling, *scalingSize);
  if (stylesApp.parsed()) return StylesOptions{};
  info.raw = rawLayout(infoText);
  return info;
}

}  // namespace burin::host
