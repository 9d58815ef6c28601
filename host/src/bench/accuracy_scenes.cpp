#include "bench/accuracy_scenes.hpp"

#include "bench/built_in_scene.hpp"

namespace burin::host::bench {

namespace {

/// What meets at a sample here are two layers, and lines with what they lie on: four passes.
constexpr std::string_view kLines = R"({
  "schema_version": 1,
  "volume": { "procedural": "ct-phantom", "dims": [128, 128, 128], "type": "i16" },
  "camera": { "azimuth_deg": 35, "elevation_deg": 10, "vertical_fov_deg": 25, "zoom": 1.6 },
  "layers": [
    { "name": "skin", "transfer_function": { "points": [
        { "value": -700, "color": "#e8b49a", "opacity": 0 },
        { "value": -400, "color": "#e8b49a", "opacity": 0.1 },
        { "value": 300, "color": "#e8b49a", "opacity": 0.02 }], "opacity_unit_length": 1 },
      "style": { "tone": {}, "edges": {} } },
    { "name": "bone", "transfer_function": { "points": [
        { "value": 200, "color": "#fff7e6", "opacity": 0 },
        { "value": 700, "color": "#fff7e6", "opacity": 0.9 }], "opacity_unit_length": 1 },
      "style": { "light": {}, "edges": {}, "specular": {} } }]
})";

}  // namespace

std::vector<NamedScene> accuracyScenes(const Communicator& comm,
                                       const BenchAccuracyOptions& options) {
  RenderOptions what;
  what.input = options.input;
  what.volume = options.volume;
  std::vector<NamedScene> scenes = benchScenes(comm, what);
  if (options.quick || !options.input.empty() || !options.volume.empty()) return scenes;
  VolumeChoice volume;
  volume.procedural = "ct-phantom";
  volume.dims = glm::ivec3{128, 128, 128};
  volume.type = "i16";
  scenes.push_back(
      {"ct-phantom-lines", builtInScene("ct-phantom-lines", kLines, openTogether(comm, volume))});
  return scenes;
}

}  // namespace burin::host::bench
