#include "scene_override.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "json_override.hpp"

namespace burin::scene_io {
namespace {

using json::Node;

struct Alternatives {
  std::string_view object, key;
  std::vector<std::string_view> excluded;
};

const std::array<Alternatives, 6>& alternatives() {
  static const std::array<Alternatives, 6> table{{
      {"camera", "view", {"azimuth_deg", "elevation_deg", "eye", "target", "up"}},
      {"camera", "eye", {"azimuth_deg", "elevation_deg", "view"}},
      {"camera", "azimuth_deg", {"view", "eye", "target"}},
      {"camera", "elevation_deg", {"view", "eye", "target"}},
      {"quality", "max_error", {"step_voxels", "termination"}},
      {"quality", "step_voxels", {"max_error"}},
  }};
  return table;
}

void drop(Node& object, const std::vector<std::string_view>& keys) {
  std::erase_if(object.members, [&](const json::Member& member) {
    return std::ranges::find(keys, member.name) != keys.end() &&
           !member.value.where.starts_with("--set");
  });
}

/// The layer that a path names; nullptr if there is none.
Node* layerOf(Node& root, const std::vector<std::string>& path) {
  Node* const layers = root.find("layers");
  if (path.size() < 2 || path[0] != "layers" || layers == nullptr) return nullptr;
  for (std::size_t i = 0; i < layers->items.size(); ++i)
    if (path[1] == std::to_string(i)) return &layers->items[i];
  return nullptr;
}

void dropAlternatives(Node& root, const std::vector<std::string>& path) {
  for (const Alternatives& one : alternatives())
    if (path.size() == 2 && path[0] == one.object && path[1] == one.key)
      if (Node* const object = root.find(one.object);
          object != nullptr && object->find(one.key) != nullptr)
        drop(*object, one.excluded);
  Node* const layer = layerOf(root, path);
  if (layer == nullptr || path.size() != 3 || path[2] != "mode") return;
  const Node* const mode = layer->find("mode");
  if (mode != nullptr && (mode->text == "mip" || mode->text == "average"))
    drop(*layer, {"style", "line_opacity"});
}

/// What a layer's style says of gradients, if the path is that style.
std::optional<json::Member> gradientOf(Node& root, const std::vector<std::string>& path) {
  Node* const layer = path.size() == 3 && path[2] == "style" ? layerOf(root, path) : nullptr;
  const Node* const style = layer != nullptr ? layer->find("style") : nullptr;
  if (style == nullptr) return std::nullopt;
  const auto found = std::ranges::find(style->members, "gradient", &json::Member::name);
  return found != style->members.end() ? std::optional{*found} : std::nullopt;
}

}  // namespace

void applySceneOverride(Node& root, const std::string& override,
                        const std::function<void()>& expand) {
  const std::vector<std::string> path = json::pathOf(override);
  const std::optional<json::Member> gradient = gradientOf(root, path);
  json::applyOverride(root, override);
  dropAlternatives(root, path);
  const Node* const layer = layerOf(root, path);
  const Node* const style = layer != nullptr ? layer->find("style") : nullptr;
  const bool isNamed = style != nullptr && style->kind == Node::Kind::kText;
  expand();
  if (!gradient || !isNamed) return;
  Node* const expanded = layerOf(root, path)->find("style");
  if (expanded->find("gradient") == nullptr)
    expanded->members.insert(expanded->members.begin(), *gradient);
}

}  // namespace burin::scene_io
