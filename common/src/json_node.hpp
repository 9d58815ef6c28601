#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "burin/common/error.hpp"

namespace burin::json {

struct Member;

/// A JSON value that knows where it was written.
struct Node {
  enum class Kind { kNull, kBoolean, kNumber, kText, kList, kObject };
  Kind kind = Kind::kNull;
  std::string where;  ///< "demo.json:3:14", or the override that brought it
  bool boolean = false;
  double number = 0;
  std::string text;
  std::vector<Node> items;      ///< of a list
  std::vector<Member> members;  ///< of an object, in the order written

  /// The object's member of that name; nullptr if there is none.
  Node* find(std::string_view name);
  const Node* find(std::string_view name) const;
};

struct Member {
  std::string name;
  std::string where;  ///< of the name
  Node value;
};

/// Reads JSON with comments. `name` begins every place: "name:line:column", columns in characters.
/// Throws Error{kUsage} for bad syntax, a key that stands twice in an object, numbers beyond double
/// and nesting deeper than any scene's.
Node read(std::string_view text, std::string_view name);

/// A value and its path in the document ("layers[0].style"): what a reader of a part is given.
struct At {
  const Node& node;
  std::string path;  ///< "" at the top

  At item(std::size_t index) const;
  At member(const Member& member) const;

  /// Throws Error{kUsage}: "where: path: message".
  template <typename... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    failAt(node.where, path, fmt::format(format, std::forward<Args>(args)...));
  }
  [[noreturn]] static void failAt(std::string_view where, std::string_view path,
                                  std::string_view message);
};

/// "layers[0].style" + "tone" → "layers[0].style.tone".
std::string childPath(std::string_view path, std::string_view name);

/// The value as a message names it: "text \"abc\"", "a list".
std::string shown(const Node& node);

}  // namespace burin::json
