#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "burin/common/camera.hpp"
#include "burin/common/scene.hpp"
#include "burin/compositor/composite_options.hpp"
#include "burin/node/worker.hpp"

namespace burin::host {

/// --dims, --type, --endian, --spacing: what a bare raw file does not say itself; --component and
/// --series: what is meant of a file that holds several.
struct RawLayout {
  std::optional<glm::ivec3> dims;
  std::optional<std::string> type;
  std::optional<std::string> endian;
  std::optional<glm::dvec3> spacing;
  std::optional<int> component;
  std::optional<std::string> series;

  /// Puts what was given into `choice`, leaves the rest of it alone.
  void applyTo(VolumeChoice& choice) const;
};

/// --labels, --label-names, --label-component
struct LabelOptions {
  std::string file;   ///< relative to the working directory; "": the scene's own
  std::string names;  ///< likewise
  std::optional<int> component;

  /// Puts what was given into `choice`; another file replaces it as a whole.
  void applyTo(LabelVolumeChoice& choice) const;
};

/// --composite, --wire, --link, --zstd
struct MergeOptions {
  compositor::CompositeOptions composite;
  bool isHalfOnWire = false;
};

/// burin render
struct RenderOptions {
  std::string input;   ///< SCENE or VOLUME; empty if only --volume was given
  std::string volume;  ///< --volume, relative to the working directory; empty: the scene's own
  std::filesystem::path output;  ///< never empty: named after the input if -o was not given
  std::optional<ImageSize> size;
  std::vector<std::string> settings;  ///< --set, in order
  RawLayout raw;
  LabelOptions labels;
  node::WorkerOptions worker;
  MergeOptions merge;
  int frames = 0;  ///< 0: one picture named as given; else numbered ones
  double orbitDeg = 360;
  bool redraw = false;  ///< frames are drawn even if nothing changed since the one before
  bool reference = false;
  bool quiet = false;
  std::filesystem::path stats;      ///< empty: none
  std::filesystem::path trace;      ///< empty: none
  std::filesystem::path saveScene;  ///< empty: no
};

/// burin info
struct InfoOptions {
  std::string volume;  ///< empty if isBuild
  RawLayout raw;
  std::string labelNames;                        ///< --label-names; "": none
  bool isBuild = false;                          ///< --build: about the program instead of a volume
  std::filesystem::path gradientHistogram = {};  ///< --histogram2d; empty: none
};

/// burin make-volume
struct MakeVolumeOptions {
  std::string kind;
  glm::ivec3 dims{1};
  std::string type = "u8";
  glm::dvec3 spacing{1};
  std::filesystem::path output;
};

/// What most benchmarks take.
struct BenchOptions {
  std::string input;   ///< SCENE or VOLUME to measure instead of the built-in scenes
  std::string volume;  ///< --volume, as of RenderOptions
  std::filesystem::path folder = "bench";  ///< --out
  bool quick = false;
};

/// burin bench compositing; INPUT is the scene whose footprints are composited
struct BenchCompositingOptions : BenchOptions {
  std::vector<int> ranks;  ///< rank counts to measure, ascending, each <= those of the run
  std::vector<int> sides;  ///< of the square frames, pixels, ascending
  int repeats = 9;
  bool dedicatedHost = false;  ///< rank 0 draws nothing
  std::string network;         ///< its name in the table; empty: found out
};

/// burin bench skip
struct BenchSkipOptions : BenchOptions {
  int side = 256;  ///< --size: voxels along each axis of the built-in volumes
  int repeats = 5;
};

/// burin bench accuracy
struct BenchAccuracyOptions : BenchOptions {
  int side = 256;  ///< --size: of the square frame
  int repeats = 5;
};

/// burin bench max-error
struct BenchMaxErrorOptions {
  std::vector<std::string> volumes;        ///< files; none: the procedural kinds
  std::filesystem::path folder = "bench";  ///< --out
  bool quick = false;
  int side = 128;                  ///< --size: of the square frames
  double smallestStep = 1.0 / 64;  ///< --smallest-step: of the fixed steps, voxels
};

/// burin bench scaling; INPUT is for strong scaling only
struct BenchScalingOptions : BenchOptions {
  std::vector<int> bricks;  ///< numbers of ranks that are measured one by one, ascending
  int side = 256;           ///< --size: voxels along each axis of the built-in volume
  int repeats = 3;
};

/// burin bench rates
struct BenchRatesOptions {
  std::vector<std::string> inputs;         ///< scenes and volumes; none: the procedural head
  std::filesystem::path folder = "bench";  ///< --out
  bool quick = false;
  int side = 512;  ///< --size: of the square frames
  int repeats = 5;
};

/// burin gallery
struct GalleryOptions {
  RenderOptions render;             ///< of every panel: `size` is a panel's, `output` the sheet
  std::vector<std::string> inputs;  ///< drawn as they are, if two or more; one is render.input's
  std::vector<std::string> styles;  ///< of one input: named ones; none: all of them
  int columns = 0;                  ///< 0: about as many as rows
};

/// burin colormap
struct ColormapOptions {
  std::string input;  ///< a colour map of another program, or a scene
  std::filesystem::path output;
  std::string map;          ///< which of the file's maps; "" the first
  int layer = 0;            ///< of the scene
  bool toParaview = false;  ///< a scene's layer to ParaView's JSON; else a colour map to a scene
};

/// burin styles
struct StylesOptions {};

/// --help and --version: text for standard output, nothing else to do.
struct Answer {
  std::string text;
};

using Command =
    std::variant<RenderOptions, InfoOptions, MakeVolumeOptions, StylesOptions, GalleryOptions,
                 ColormapOptions, BenchCompositingOptions, BenchSkipOptions, BenchAccuracyOptions,
                 BenchMaxErrorOptions, BenchScalingOptions, BenchRatesOptions, Answer>;

/// Reads the arguments (without the program's name). Depends on nothing else, so that all ranks
/// come to the same result. `ranks`: how many take part. Throws Error{kUsage}, one line.
Command parseCommandLine(std::span<const char* const> arguments, int ranks);

/// Whether an input file is a scene: by its name, which ends in .json or .jsonc.
bool isSceneFile(const std::filesystem::path& file);

/// "X,Y,Z" or "XxYxZ", e.g. "256x256x128"; each in [1, 2^20]. Throws Error{kUsage} naming `option`.
glm::ivec3 parseDims(const std::string& text, const std::string& option);
/// "X,Y,Z", e.g. "0.5,0.5,1.2"; each finite and > 0. Throws Error{kUsage} naming `option`.
glm::dvec3 parseSpacing(const std::string& text, const std::string& option);
/// "WxH", e.g. "1024x768"; the scene checks the range. Throws Error{kUsage}.
ImageSize parseSize(const std::string& text);

/// "1.2.3", the version of this program.
const char* programVersion();

}  // namespace burin::host
