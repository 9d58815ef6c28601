#include "bench/skip_scenes.hpp"

#include <string_view>
#include <utility>

#include "bench/ball_volume.hpp"
#include "bench/built_in_scene.hpp"
#include "bench/memory_source.hpp"
#include "burin/node/procedural.hpp"

namespace burin::host::bench {

namespace {

/// Plain: styles would make what is visible dearer, and skipping look better. Opacity rises well
/// above the value of what is empty: from that value on, nothing would be provably empty.
constexpr std::string_view kBallLook = R"({
  "schema_version": 1,
  "camera": { "azimuth_deg": 30, "elevation_deg": 20, "vertical_fov_deg": 30, "zoom": 1.5 },
  "quality": { "termination": 0 },
  "layers": [{ "name": "balls", "transfer_function": { "points": [
    { "value": 64, "color": "#3b5b8c", "opacity": 0 },
    { "value": 255, "color": "#e8dcc0", "opacity": 0.01 }], "opacity_unit_length": 1 } }]
})";
constexpr std::string_view kVesselLook = R"({
  "schema_version": 1,
  "camera": { "azimuth_deg": 20, "elevation_deg": 8, "vertical_fov_deg": 25, "zoom": 1.7 },
  "quality": { "termination": 0 },
  "layers": [{ "name": "vessels", "transfer_function": { "points": [
    { "value": 60, "color": "#8f1d18", "opacity": 0 },
    { "value": 160, "color": "#d8473a", "opacity": 0.9 }], "opacity_unit_length": 1 } }]
})";

PreparedScene inSquareFrame(PreparedScene prepared, int side) {
  prepared.scene.imageSize = {2 * side, 2 * side};
  return prepared;
}

}  // namespace

PreparedScene ballScene(int count, double fraction, int side) {
  return inSquareFrame(builtInScene("balls", kBallLook, makeBalls(count, fraction, side)), side);
}

PreparedScene vesselScene(int side) {
  const auto vessels =
      node::makeProcedural("vessels", glm::ivec3{side}, node::VoxelType::kU8, glm::dvec3{1});
  return inSquareFrame(builtInScene("vessels", kVesselLook, inMemory(*vessels)), side);
}

}  // namespace burin::host::bench
