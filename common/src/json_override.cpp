#include "json_override.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

namespace burin::json {

namespace {

std::vector<std::string> steps(std::string_view path) {
  std::vector<std::string> result(1);
  for (const char c : path) {
    if (c == '.' || c == '[') {
      result.emplace_back();
    } else if (c != ']') {
      result.back() += c;
    }
  }
  return result;
}

std::optional<std::size_t> listIndex(const std::string& step) {
  std::size_t index = 0;
  const char* end = step.data() + step.size();
  const auto [stop, error] = std::from_chars(step.data(), end, index);
  return error == std::errc{} && stop == end ? std::optional{index} : std::nullopt;
}

void setPlace(Node& node, const std::string& where) {
  node.where = where;
  for (Node& item : node.items) setPlace(item, where);
  for (Member& member : node.members) {
    member.where = where;
    setPlace(member.value, where);
  }
}

/// The value on the right of '=': JSON if it is, else a word.
Node overrideValue(std::string_view text, const std::string& where) {
  Node value;
  const bool meantAsJson = text.starts_with('{') || text.starts_with('[') || text.starts_with('"');
  try {
    value = read(text, where);
  } catch (const Error&) {
    if (meantAsJson) throw;
    value.kind = Node::Kind::kText;
    value.text = text;
  }
  setPlace(value, where);
  return value;
}

/// The child that `step` names, made if it is missing.
Node& descend(Node& parent, const std::string& step, const std::string& path,
              const std::string& where) {
  if (parent.kind == Node::Kind::kList) {
    const auto index = listIndex(step);
    if (!index || *index > parent.items.size()) {
      At::failAt(where, path,
                 fmt::format("'{}' is no item of a list of {}", step, parent.items.size()));
    }
    if (*index == parent.items.size()) parent.items.emplace_back();
    return parent.items[*index];
  }
  if (parent.kind == Node::Kind::kNull) {  // just made
    parent.kind =
        listIndex(step) == std::optional<std::size_t>{0} ? Node::Kind::kList : Node::Kind::kObject;
    parent.where = where;
    return descend(parent, step, path, where);
  }
  if (parent.kind != Node::Kind::kObject) {
    At::failAt(where, path, fmt::format("is {}, which has no '{}'", shown(parent), step));
  }
  if (Node* found = parent.find(step)) return *found;
  parent.members.push_back({step, where, {}});
  return parent.members.back().value;
}

}  // namespace

std::vector<std::string> pathOf(std::string_view override) {
  return steps(override.substr(0, override.find('=')));
}

void applyOverride(Node& root, std::string_view override) {
  const std::string where = fmt::format("--set {}", override);
  const std::size_t equals = override.find('=');
  if (equals == 0 || equals == override.npos) {
    At::failAt(where, "", "expected path=value, such as layers.0.style.tone.strength=0.5");
  }
  Node value = overrideValue(override.substr(equals + 1), where);
  Node* parent = &root;
  std::string path;
  const std::vector<std::string> path_steps = pathOf(override);
  for (std::size_t i = 0; i + 1 < path_steps.size(); ++i) {
    const bool inList = parent->kind == Node::Kind::kList;
    parent = &descend(*parent, path_steps[i], path, where);
    path = inList ? fmt::format("{}[{}]", path, path_steps[i]) : childPath(path, path_steps[i]);
  }
  if (value.kind == Node::Kind::kNull && parent->kind == Node::Kind::kObject) {
    std::erase_if(parent->members, [&](const Member& m) { return m.name == path_steps.back(); });
    return;
  }
  descend(*parent, path_steps.back(), path, where) = std::move(value);
}

}  // namespace burin::json
