#include "shader_conditions.hpp"

#include <algorithm>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

/// The first word of `text`, which is left without it.
std::string_view takeWord(std::string_view& text) {
  const std::string_view word = text.substr(0, text.find(' '));
  text.remove_prefix(std::min(word.size() + 1, text.size()));
  return word;
}

}  // namespace

bool ShaderConditions::keeps(std::string_view line) {
  if (!line.starts_with('#')) return isOpen();
  const std::string_view directive = takeWord(line);
  if (directive == "#ifdef") {
    begin(defined_.contains(line));
  } else if (directive == "#if") {
    begin(holds(line));
  } else if (directive == "#elif") {
    turn(holds(line));
  } else if (directive == "#else") {
    turn(true);
  } else if (directive == "#endif") {
    end();
  } else {
    BURIN_CHECK(directive != "#ifndef" && directive != "#undef");
    if (isOpen() && directive == "#define") defined_.emplace(takeWord(line));
    return isOpen();
  }
  return false;
}

void ShaderConditions::begin(bool condition) {
  branches_.push_back({.isOpen = isOpen() && condition, .isDone = !isOpen() || condition});
}

void ShaderConditions::turn(bool condition) {
  BURIN_CHECK(!branches_.empty());
  Branch& branch = branches_.back();
  branch.isOpen = !branch.isDone && condition;
  branch.isDone = branch.isDone || condition;
}

void ShaderConditions::end() {
  BURIN_CHECK(!branches_.empty());
  branches_.pop_back();
}

bool ShaderConditions::holds(std::string_view expression) const {
  constexpr std::string_view kDefined = "defined(";
  const bool isAll = expression.find("&&") != std::string_view::npos;
  BURIN_CHECK(!isAll || expression.find("||") == std::string_view::npos);
  bool result = isAll;
  while (!expression.empty()) {
    expression.remove_prefix(std::min(expression.find_first_not_of(" |&"), expression.size()));
    BURIN_CHECK(expression.starts_with(kDefined));
    expression.remove_prefix(kDefined.size());
    const std::size_t close = expression.find(')');
    BURIN_CHECK(close != std::string_view::npos);
    const bool is = defined_.contains(expression.substr(0, close));
    result = isAll ? result && is : result || is;
    expression.remove_prefix(close + 1);
  }
  return result;
}

}  // namespace burin::node
