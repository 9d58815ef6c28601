#include "style_file.hpp"

#include <algorithm>

#include "burin/common/named_style.hpp"
#include "burin/common/nearest_name.hpp"
#include "scene_codec.hpp"
#include "text_file.hpp"

namespace burin::scene_io {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBase = "base";
constexpr std::string_view kWithout = "without";

fs::path findStyleFile(const At& at, const fs::path& folder) {
  const std::string& name = at.node.text;
  if (name.find('/') != name.npos || name.ends_with(".json")) return folder / name;
  std::vector<std::string> known;
  for (const fs::path& place : styleFolders()) {
    fs::path file = place / (name + ".json");
    if (!name.empty() && fs::exists(file)) return file;
    for (const auto& entry : fs::directory_iterator{place})
      if (entry.path().extension() == ".json") known.push_back(entry.path().stem().string());
  }
  if (known.empty())
    at.fail("style '{}' is not found: no folder of styles is (BURIN_STYLES)", name);
  std::ranges::sort(known);
  at.fail("style '{}' is unknown; {}", name,
          nameSuggestion(name, std::vector<std::string_view>(known.begin(), known.end())));
}

Node namedStyle(const At& at, const fs::path& folder) {
  if (at.node.kind != Node::Kind::kText)
    at.fail("expected the name of a style, found {}", json::shown(at.node));
  return readStyleFile(findStyleFile(at, folder)).style;
}

void removeMember(Node& object, std::string_view name) {
  std::erase_if(object.members, [&](const json::Member& m) { return m.name == name; });
}

void removeListed(Node& style, const At& list) {
  checkList(list, 1, std::numeric_limits<std::size_t>::max());
  for (std::size_t i = 0; i < list.node.items.size(); ++i) {
    const At effect = list.item(i);
    if (effect.node.kind != Node::Kind::kText || style.find(effect.node.text) == nullptr)
      effect.fail("the named style has no {}", json::shown(effect.node));
    removeMember(style, effect.node.text);
  }
}

/// `changes` into `target`: objects member by member, anything else as a whole.
void merge(Node& target, const Node& changes) {
  if (target.kind != Node::Kind::kObject || changes.kind != Node::Kind::kObject) {
    target = changes;
    return;
  }
  for (const json::Member& change : changes.members) {
    if (Node* found = target.find(change.name)) {
      merge(*found, change.value);
    } else {
      target.members.push_back(change);
    }
  }
}

void expand(Node& style, const std::string& path, const fs::path& folder) {
  if (style.kind == Node::Kind::kText) {
    style = namedStyle({style, path}, folder);
    return;
  }
  const Node* base = style.find(kBase);
  if (base == nullptr) return;
  Node expanded = namedStyle({*base, json::childPath(path, kBase)}, folder);
  if (const Node* without = style.find(kWithout))
    removeListed(expanded, {*without, json::childPath(path, kWithout)});
  removeMember(style, kBase);
  removeMember(style, kWithout);
  merge(expanded, style);
  style = std::move(expanded);
}

}  // namespace

StyleFile readStyleFile(const fs::path& file) {
  const Node root = json::read(readSmallFile(file, "the style"), file.string());
  checkKeys({root, ""}, {"description", "style"});
  const Node* description = root.find("description");
  const Node* style = root.find("style");
  if (description == nullptr || style == nullptr)
    At{root, ""}.fail("expected 'description' and 'style'");
  if (style->find(kBase) != nullptr) At{*style, "style"}.fail("a named style has no base");
  return {text().read({*description, "description"}), *style};
}

void expandNamedStyles(Node& scene, const fs::path& folder) {
  Node* layers = scene.find("layers");
  if (layers == nullptr) return;
  for (std::size_t i = 0; i < layers->items.size(); ++i) {
    if (Node* style = layers->items[i].find("style"))
      expand(*style, fmt::format("layers[{}].style", i), folder);
  }
}

}  // namespace burin::scene_io
