#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "burin/common/colour_map.hpp"
#include "burin/common/log.hpp"
#include "burin/common/nearest_name.hpp"
#include "scene_codec.hpp"
#include "text_file.hpp"

namespace burin {

namespace {

using scene_io::At;
using scene_io::Codec;
using scene_io::Document;
using scene_io::Node;

const Codec<double>& anyNumber() {
  static const Codec<double> codec = scene_io::number(scene_io::kAnyNumber);
  return codec;
}

/// Numbers in groups of `size`, at least one group.
std::vector<std::vector<double>> groups(const At& at, std::size_t size) {
  scene_io::checkList(at, size, std::numeric_limits<std::size_t>::max());
  if (at.node.items.size() % size != 0)
    at.fail("expected {} numbers for each point, found {} in all", size, at.node.items.size());
  std::vector<std::vector<double>> result(at.node.items.size() / size);
  for (std::size_t i = 0; i < at.node.items.size(); ++i)
    result[i / size].push_back(anyNumber().read(at.item(i)));
  return result;
}

std::optional<At> memberOf(const At& at, std::string_view name) {
  const Node* found = at.node.find(name);
  if (found == nullptr || found->kind == Node::Kind::kNull) return std::nullopt;
  return At{*found, json::childPath(at.path, name)};
}

At needed(const At& at, std::string_view name) {
  const std::optional<At> found = memberOf(at, name);
  if (!found) at.fail("'{}' is missing", name);
  return *found;
}

double numberOr(const At& at, std::string_view name, double otherwise) {
  const std::optional<At> found = memberOf(at, name);
  return found ? anyNumber().read(*found) : otherwise;
}

/// A node's own range, so that nothing behind it need care.
template <typename N>
void addNode(const At& at, std::vector<N>& nodes, N node) {
  const auto isShare = [](double value) { return value >= 0 && value <= 1; };
  if (!isShare(node.midpoint) || !isShare(node.sharpness))
    at.fail("midpoint {} and sharpness {}: expected numbers in [0, 1]", node.midpoint,
            node.sharpness);
  nodes.push_back(node);
}

template <typename N>
void sortByValue(std::vector<N>& nodes) {
  std::ranges::stable_sort(nodes, {}, &N::x);
}

// ParaView

ColourSpace colourSpace(const At& at) {
  constexpr std::pair<std::string_view, ColourSpace> kSpaces[] = {
      {"RGB", ColourSpace::kRgb},
      {"HSV", ColourSpace::kHsv},
      {"Lab", ColourSpace::kLab},
      {"Diverging", ColourSpace::kDiverging},
      {"Step", ColourSpace::kStep}};
  std::vector<std::string_view> names;
  for (const auto& [name, space] : kSpaces) {
    if (at.node.text == name) return space;
    names.push_back(name);
  }
  at.fail("colour space {} is unknown; {}", json::shown(at.node),
          nameSuggestion(at.node.text, names));
}

ColourMap paraviewMap(const At& at) {
  ColourMap map;
  if (const auto name = memberOf(at, "Name")) map.name = name->node.text;
  if (const auto space = memberOf(at, "ColorSpace")) map.space = colourSpace(*space);
  if (const auto wrap = memberOf(at, "HSVWrap"))
    map.hueWraps = wrap->node.boolean || wrap->node.number != 0;
  if (memberOf(at, "IndexedColors") && !memberOf(at, "RGBPoints"))
    at.fail("a list of colours for categories has no values to go by");
  for (const auto& p : groups(needed(at, "RGBPoints"), 4))
    map.colours.push_back({p[0], {p[1], p[2], p[3]}});
  if (const auto opacities = memberOf(at, "Points")) {
    for (const auto& p : groups(*opacities, 4))
      addNode(*opacities, map.opacities, {p[0], p[1], p[2], p[3]});
  }
  return map;
}

ColourMap paraviewMap(const At& list, std::string_view wanted) {
  scene_io::checkList(list, 1, std::numeric_limits<std::size_t>::max());
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < list.node.items.size(); ++i) {
    const At at = list.item(i);
    const auto name = memberOf(at, "Name");
    if (wanted.empty() || (name && name->node.text == wanted)) return paraviewMap(at);
    if (name) names.push_back(name->node.text);
  }
  list.fail("no map is called '{}'; {}", wanted, nameSuggestion(wanted, names));
}

// 3D Slicer, JSON

/// The first item of a list.
At firstOf(const At& list) {
  scene_io::checkList(list, 1, std::numeric_limits<std::size_t>::max());
  return list.item(0);
}

std::vector<OpacityNode> slicerFunction(const At& at) {
  const At points = needed(at, "points");
  scene_io::checkList(points, 1, std::numeric_limits<std::size_t>::max());
  std::vector<OpacityNode> nodes;
  for (std::size_t i = 0; i < points.node.items.size(); ++i) {
    const At point = points.item(i);
    addNode(point, nodes,
            {anyNumber().read(needed(point, "x")), anyNumber().read(needed(point, "y")),
             numberOr(point, "midpoint", 0.5), numberOr(point, "sharpness", 0)});
  }
  return nodes;
}

bool isOne(const std::vector<OpacityNode>& nodes) {
  return std::ranges::all_of(nodes, [](const OpacityNode& node) { return node.opacity == 1; });
}

ColourMap slicerMap(const At& root) {
  const At component = firstOf(needed(firstOf(needed(root, "volumeProperties")), "components"));
  ColourMap map;
  const At points = needed(needed(component, "rgbTransferFunction"), "points");
  scene_io::checkList(points, 1, std::numeric_limits<std::size_t>::max());
  for (std::size_t i = 0; i < points.node.items.size(); ++i) {
    const At point = points.item(i);
    const auto colour = groups(needed(point, "color"), 3).front();
    addNode(point, map.colours,
            {anyNumber().read(needed(point, "x")),
             {colour[0], colour[1], colour[2]},
             numberOr(point, "midpoint", 0.5),
             numberOr(point, "sharpness", 0)});
  }
  map.opacities = slicerFunction(needed(component, "scalarOpacity"));
  if (const auto gradient = memberOf(component, "gradientOpacity"))
    map.hasGradientOpacity = !isOne(slicerFunction(*gradient));
  const double unit = numberOr(component, "scalarOpacityUnitDistance", 0);
  if (unit > 0) map.unitLength = unit;
  return map;
}

// 3D Slicer, lines of text

/// The numbers of a line that begins with how many there are.
std::vector<double> countedNumbers(const std::string& place, const std::string& line,
                                   std::size_t groupSize) {
  std::istringstream in{line};
  std::size_t count = 0;
  std::vector<double> numbers;
  in >> count;
  for (double number = 0; numbers.size() < count && in >> number;) numbers.push_back(number);
  if (numbers.empty() || numbers.size() != count || count % groupSize != 0) {
    fail(ExitCode::kUsage, "{}: expected how many numbers follow, and {} for each point", place,
         groupSize);
  }
  return numbers;
}

ColourMap slicerTextMap(const std::string& text, const std::string& name) {
  // Interpolation, shading and four numbers of lighting come first.
  constexpr std::size_t kScalarOpacity = 6, kGradientOpacity = 7, kColour = 8;
  std::vector<std::string> lines;
  std::istringstream in{text};
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  if (lines.size() <= kColour)
    fail(ExitCode::kUsage, "{}: {} lines, expected at least {}", name, lines.size(), kColour + 1);
  const auto numbers = [&](std::size_t line, std::size_t groupSize) {
    return countedNumbers(fmt::format("{}:{}", name, line + 1), lines[line], groupSize);
  };
  ColourMap map;
  const std::vector<double> opacities = numbers(kScalarOpacity, 2);
  for (std::size_t i = 0; i < opacities.size(); i += 2)
    map.opacities.push_back({opacities[i], opacities[i + 1]});
  const std::vector<double> gradients = numbers(kGradientOpacity, 2);
  for (std::size_t i = 1; i < gradients.size(); i += 2)
    map.hasGradientOpacity = map.hasGradientOpacity || gradients[i] != 1;
  const std::vector<double> colours = numbers(kColour, 4);
  for (std::size_t i = 0; i < colours.size(); i += 4)
    map.colours.push_back({colours[i], {colours[i + 1], colours[i + 2], colours[i + 3]}});
  return map;
}

ColourMap jsonMap(const At& root, std::string_view map) {
  if (root.node.kind == Node::Kind::kList) return paraviewMap(root, map);
  if (root.node.find("volumeProperties") != nullptr) return slicerMap(root);
  if (root.node.find("RGBPoints") != nullptr) return paraviewMap(root);
  if (root.node.find("layers") != nullptr)
    root.fail("a scene, no colour map (burin colormap --paraview makes one of it)");
  root.fail("neither a colour map of ParaView nor a volume property of 3D Slicer");
}

/// Colours and opacities in their ranges; other programs cut them off there.
void clampAll(ColourMap& map) {
  for (ColourNode& node : map.colours) node.colour = glm::clamp(node.colour, 0.0, 1.0);
  for (OpacityNode& node : map.opacities) node.opacity = std::clamp(node.opacity, 0.0, 1.0);
}

}  // namespace

ColourMap readColourMap(const std::filesystem::path& file, std::string_view map) {
  const std::string text = readSmallFile(file, "the colour map");
  ColourMap read = file.extension() == ".vp" ? slicerTextMap(text, file.string())
                                             : jsonMap({json::read(text, file.string()), ""}, map);
  sortByValue(read.colours);
  sortByValue(read.opacities);
  clampAll(read);
  if (read.hasGradientOpacity)
    note("{}: its opacity by gradient is left out (the style \"surface\" has one)", file.string());
  return read;
}

}  // namespace burin
