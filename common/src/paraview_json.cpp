#include <algorithm>
#include <cmath>
#include <limits>

#include "burin/common/colour_map.hpp"
#include "burin/common/error.hpp"
#include "json_format.hpp"

namespace burin {

namespace {

/// sRGB in [0, 1] and opacity at a value.
struct MapNode {
  double x;
  glm::dvec3 colour;
  double opacity;
};

MapNode nodeAt(const TransferFunction& function, double x) {
  constexpr double kUnit = 1;
  const Classified found = function.classify(x, kUnit);
  return {x,
          {srgbFromLinear(found.colour.r), srgbFromLinear(found.colour.g),
           srgbFromLinear(found.colour.b)},
          -std::expm1(-found.extinction * kUnit)};
}

MapNode nodeOf(const TransferPoint& point) {
  return {point.value, glm::dvec3{point.colour.r, point.colour.g, point.colour.b} / 255.0,
          point.opacity};
}

/// Adds nodes strictly between two, until colours that are linear in sRGB are as near as stated to
/// those that are linear in light.
void addBetween(const TransferFunction& piece, const MapNode& from, const MapNode& to,
                std::vector<MapNode>& nodes, int depth) {
  constexpr int kDeepest = 9;
  constexpr int kProbes = 4;
  const double middle = (from.x + to.x) / 2;
  if (depth == kDeepest || !(from.x < middle && middle < to.x)) return;
  bool isLinear = true;
  for (int i = 1; i < kProbes; ++i) {
    const double t = static_cast<double>(i) / kProbes;
    const glm::dvec3 codes = 255.0 * glm::abs(nodeAt(piece, (1 - t) * from.x + t * to.x).colour -
                                              ((1 - t) * from.colour + t * to.colour));
    isLinear = isLinear && std::max({codes.r, codes.g, codes.b}) < 0.5 * kColourMapCodes;
  }
  if (isLinear) return;
  const MapNode between = nodeAt(piece, middle);
  addBetween(piece, from, between, nodes, depth + 1);
  nodes.push_back(between);
  addBetween(piece, between, to, nodes, depth + 1);
}

std::vector<MapNode> nodesOf(const TransferFunction& function) {
  std::vector<MapNode> nodes{nodeOf(function.points.front())};
  for (std::size_t i = 1; i < function.points.size(); ++i) {
    const TransferPoint& from = function.points[i - 1];
    const TransferPoint& to = function.points[i];
    addBetween({{from, to}, {}}, nodeOf(from), nodeOf(to), nodes, 0);
    // VTK keeps one node at a value, so the lower end of a step moves down as little as it can.
    if (to.value == from.value)
      nodes.back().x = std::nextafter(to.value, -std::numeric_limits<double>::infinity());
    nodes.push_back(nodeOf(to));
  }
  return nodes;
}

}  // namespace

std::string paraviewJson(const TransferFunction& function, std::string_view name) {
  if (function.isTwoDimensional())
    fail(ExitCode::kUsage,
         "'widgets' depend on the gradient: ParaView's colour maps hold a transfer function of "
         "points only");
  BURIN_CHECK(!function.points.empty());
  json::Document colours = json::Document::array();
  json::Document opacities = json::Document::array();
  for (const MapNode& node : nodesOf(function)) {
    for (const double value : {node.x, node.colour.r, node.colour.g, node.colour.b})
      colours.push_back(json::numberDocument(value));
    for (const double value : {node.x, node.opacity, 0.5, 0.0})  // midpoint, sharpness: linear
      opacities.push_back(json::numberDocument(value));
  }
  json::Document map{{"ColorSpace", "RGB"}, {"Name", name}};
  map["RGBPoints"] = std::move(colours);
  map["Points"] = std::move(opacities);
  json::Document list = json::Document::array();
  list.push_back(std::move(map));
  return json::format(list);
}

}  // namespace burin
