#include "bench/scaling_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "bench/built_in_scene.hpp"
#include "bench/memory_source.hpp"
#include "burin/common/error.hpp"
#include "burin/node/procedural.hpp"

namespace burin::host::bench {

namespace {

constexpr std::string_view kHead = R"({
  "schema_version": 1,
  "camera": { "azimuth_deg": 35, "elevation_deg": 10, "vertical_fov_deg": 25, "zoom": 1.6 },
  "layers": [{ "name": "head", "transfer_function": { "points": [
    { "value": -700, "color": "#e8b49a", "opacity": 0 },
    { "value": -400, "color": "#e8b49a", "opacity": 0.05 },
    { "value": 300, "color": "#e8dcc0", "opacity": 0.01 },
    { "value": 700, "color": "#fff7e6", "opacity": 0.9 }], "opacity_unit_length": 1 },
    "style": { "light": {} } }]
})";

constexpr std::string_view kSkin = R"({ "name": "skin", "transfer_function": { "points": [
    { "value": -700, "color": "#e8b49a", "opacity": 0 },
    { "value": -400, "color": "#e8b49a", "opacity": 0.05 },
    { "value": -150, "color": "#f0c7b0", "opacity": 0.01 },
    { "value": 150, "color": "#f0c7b0", "opacity": 0 }], "opacity_unit_length": 1 },
    "style": { "tone": {}, "edges": {} } },)";
constexpr std::string_view kBone = R"({ "name": "bone", "transfer_function": { "points": [
    { "value": 300, "color": "#e8dcc0", "opacity": 0 },
    { "value": 700, "color": "#fff7e6", "opacity": 0.9 }], "opacity_unit_length": 1 },
    "style": { "tone": {}, "edges": {} } })";

std::unique_ptr<node::BrickSource> head(const glm::ivec3& dims) {
  return node::makeProcedural("ct-phantom", dims, node::VoxelType::kI16, glm::dvec3{1});
}

PreparedScene inSquareFrame(PreparedScene prepared, int side) {
  prepared.scene.imageSize = {side, side};
  return prepared;
}

/// The largest divisor of `number` up to `most`.
int divisorUpTo(int number, int most) {
  while (number % most != 0) --most;
  return most;
}

int rounded(double value) {
  return static_cast<int>(std::lround(value));
}

}  // namespace

PreparedScene strongScene(int side) {
  return inSquareFrame(builtInScene("ct-phantom", kHead, head(glm::ivec3{side})), 2 * side);
}

glm::ivec3 weakDims(int cells, int ranks) {
  // Rounded down but for the last bit: cbrt(27) may come out below 3.
  const int z = divisorUpTo(ranks, std::max(1, static_cast<int>(std::cbrt(ranks) + 1e-6)));
  const int y = divisorUpTo(ranks / z, std::max(1, static_cast<int>(std::sqrt(ranks / z) + 1e-6)));
  return glm::ivec3{ranks / z / y, y, z} * cells + 1;
}

PreparedScene weakScene(int cells, int ranks) {
  const auto source = head(weakDims(cells, ranks));
  return inSquareFrame(builtInScene("ct-phantom", kHead, inMemory(*source)),
                       rounded(2 * cells * std::cbrt(ranks)));
}

PreparedScene lumMaScene(int side, int layers) {
  BURIN_CHECK(layers == 1 || layers == 2);
  const std::string text =
      fmt::format(R"({{ "schema_version": 1, "camera": {{ "azimuth_deg": 35, "elevation_deg": 10,
    "vertical_fov_deg": 25, "zoom": 1.6 }}, "layers": [{}{}] }})",
                  layers == 2 ? kSkin : "", kBone);
  const auto source = head(glm::ivec3{side});
  return inSquareFrame(builtInScene("lum-ma", text, inMemory(*source)), side);
}

}  // namespace burin::host::bench
