#include "bench/compositing_input.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <string_view>

#include "bench/output_folder.hpp"
#include "bench/single_image_scene.hpp"
#include "bench/trim.hpp"
#include "burin/common/error.hpp"
#include "burin/compositor/pixel_algebra.hpp"
#include "burin/host/shared_error.hpp"

namespace burin::host::bench {

namespace {

using compositor::Over;
using compositor::Subimage;

/// Plain transfer functions: what a pixel costs to draw does not matter here. The volumes are
/// small for the same reason; a footprint's shape is that of the large one.
constexpr std::string_view kVessels = R"({
  "schema_version": 1,
  "volume": { "procedural": "vessels", "dims": [128, 128, 128], "type": "u8" },
  "camera": { "azimuth_deg": 20, "elevation_deg": 8, "vertical_fov_deg": 25, "zoom": 1.7 },
  "layers": [{ "name": "vessels", "transfer_function": { "points": [
    { "value": 60, "color": "#8f1d18", "opacity": 0 },
    { "value": 160, "color": "#d8473a", "opacity": 0.9 }], "opacity_unit_length": 1 } }]
})";
constexpr std::string_view kCtPhantom = R"({
  "schema_version": 1,
  "volume": { "procedural": "ct-phantom", "dims": [128, 128, 128], "type": "i16" },
  "camera": { "azimuth_deg": 35, "elevation_deg": 10, "vertical_fov_deg": 25, "zoom": 1.6 },
  "layers": [{ "name": "head", "transfer_function": { "points": [
    { "value": -700, "color": "#e8b49a", "opacity": 0 },
    { "value": -400, "color": "#e8b49a", "opacity": 0.05 },
    { "value": 300, "color": "#e8dcc0", "opacity": 0.01 },
    { "value": 700, "color": "#fff7e6", "opacity": 0.9 }], "opacity_unit_length": 1 } }]
})";

/// What the table calls a file: none of our own inputs' names.
std::string inputName(const std::filesystem::path& file) {
  const std::string name = tableName(file);
  return name == "dense" || name == "disc" ? name + "-scene" : name;
}

NamedScene builtInScene(const Communicator& comm, const std::string& name, std::string_view text) {
  NamedScene named{name, {}};
  named.prepared.scene = parseScene(text, "built-in scene " + name);
  named.prepared.source = openTogether(comm, named.prepared.scene.volume);
  const node::VolumeInfo& info = named.prepared.source->info();
  named.prepared.facts = {info.grid, info.anatomical};
  resolveScene(named.prepared.scene, named.prepared.facts);
  return named;
}

double meanActiveFraction(const Communicator& comm, const Subimage<Rgba>& mine) {
  const auto active = std::ranges::count_if(
      mine.pixels, [](const Rgba& pixel) { return !Over::isIdentity(pixel); });
  double sum = static_cast<double>(active) / static_cast<double>(mine.frame.pixels());
  allReduce(comm, std::span{&sum, 1}, MPI_SUM);
  return sum / comm.size();
}

std::vector<Rank> ranksOf(const Communicator& comm) {
  std::vector<Rank> ranks;
  for (int rank = 0; rank < comm.size(); ++rank) ranks.push_back(Rank{rank});
  return ranks;
}

/// Uniform, the same on every platform and in every run.
class RandomPixels {
 public:
  explicit RandomPixels(const Communicator& comm)
      : random_{static_cast<unsigned>(comm.rank()) + 1} {}
  float unit() { return static_cast<float>(random_() >> 8) * 0x1p-24f; }
  /// Premultiplied, opacity in [1/256, 1/2]: all ranks behind shine through.
  Rgba pixel() {
    const float a = 0x1p-8f + (0.5f - 0x1p-8f) * unit();
    return {a * unit(), a * unit(), a * unit(), a};
  }

 private:
  std::mt19937 random_;
};

}  // namespace

std::vector<NamedScene> benchScenes(const Communicator& comm, const RenderOptions& options) {
  std::vector<NamedScene> scenes;
  if (options.input.empty() && options.volume.empty()) {
    scenes.push_back(builtInScene(comm, "vessels", kVessels));
    scenes.push_back(builtInScene(comm, "ct-phantom", kCtPhantom));
  } else {
    const std::filesystem::path file = options.input.empty() ? options.volume : options.input;
    scenes.push_back({inputName(file), prepareSingleImage(comm, options)});
  }
  return scenes;
}

SceneInput::SceneInput(const Communicator& comm, NamedScene& scene, bool dedicatedHost)
    : comm_{comm},
      scene_{scene},
      worker_{comm, scene.prepared.scene, *scene.prepared.source,
              workerOptions(scene.prepared, {.dedicatedHost = dedicatedHost})} {}

CompositingInput SceneInput::make(ImageSize frame) {
  scene_.prepared.scene.imageSize = frame;
  const Camera camera = resolveCamera(scene_.prepared.scene, scene_.prepared.facts);
  CompositingInput input;
  input.name = scene_.name;
  collectively(comm_, "drawing", [&] {
    RankStatistics unused;
    input.mine = worker_.draw(camera, unused);
    trim<Over>(input.mine);
  });
  input.order = worker_.visibilityOrder(camera);
  input.activeFraction = meanActiveFraction(comm_, input.mine);
  return input;
}

CompositingInput denseInput(const Communicator& comm, ImageSize frame, bool dedicatedHost) {
  CompositingInput input;
  input.name = "dense";
  input.mine = {frame, {0, 0, frame.width, frame.height}, std::vector<Rgba>(frame.pixels())};
  RandomPixels random{comm};
  std::ranges::generate(input.mine.pixels, [&] { return random.pixel(); });
  if (dedicatedHost && comm.isRoot()) input.mine = {frame, {}, {}};
  input.order = ranksOf(comm);
  input.activeFraction = meanActiveFraction(comm, input.mine);
  return input;
}

CompositingInput discInput(const Communicator& comm, ImageSize frame, double fraction,
                           bool dedicatedHost) {
  CompositingInput input;
  input.name = "disc";
  const double radius =
      std::sqrt(fraction * static_cast<double>(frame.pixels()) / std::numbers::pi);
  const int diameter = static_cast<int>(std::ceil(2 * radius));
  BURIN_CHECK(diameter <= std::min(frame.width, frame.height));
  RandomPixels random{comm};
  const auto place = [&](int side) {
    return static_cast<int>(random.unit() * static_cast<float>(side - diameter));
  };
  const int x0 = place(frame.width);
  const int y0 = place(frame.height);
  const PixelRect active{x0, y0, x0 + diameter, y0 + diameter};
  input.mine = {frame, active, std::vector<Rgba>(active.pixels())};
  auto pixel = input.mine.pixels.begin();
  for (int y = 0; y < diameter; ++y) {
    for (int x = 0; x < diameter; ++x, ++pixel) {
      if (std::hypot(x + 0.5 - radius, y + 0.5 - radius) <= radius) *pixel = random.pixel();
    }
  }
  if (dedicatedHost && comm.isRoot()) input.mine = {frame, {}, {}};
  input.order = ranksOf(comm);
  input.activeFraction = meanActiveFraction(comm, input.mine);
  return input;
}

}  // namespace burin::host::bench
