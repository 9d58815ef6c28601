#include "json_format.hpp"

#include <algorithm>
#include <cmath>

namespace burin::json {

namespace {

constexpr std::size_t kLineWidth = 100;

std::string scalar(const Document& value) {
  return value.dump(-1, ' ', false, Document::error_handler_t::replace);
}

/// The value on one line.
std::string inlineText(const Document& value) {
  if (!value.is_structured()) return scalar(value);
  if (value.empty()) return value.is_object() ? "{}" : "[]";
  std::string text;
  for (const auto& [key, child] : value.items()) {
    if (!text.empty()) text += ", ";
    if (value.is_object()) text += scalar(key) + ": ";
    text += inlineText(child);
  }
  return value.is_object() ? "{ " + text + " }" : "[" + text + "]";
}

bool holdsObjects(const Document& value) {
  return std::any_of(value.begin(), value.end(),
                     [](const Document& child) { return child.is_object() && !child.empty(); });
}

void append(std::string& text, const Document& value, std::size_t indent, std::size_t column) {
  const bool breaks =
      value.is_structured() && !value.empty() && (indent == 0 || holdsObjects(value));
  if (!breaks) {
    const std::string line = inlineText(value);
    // One more column for the comma that may follow.
    if (!value.is_structured() || column + line.size() + 1 <= kLineWidth) {
      text += line;
      return;
    }
  }
  const std::string margin(indent + 2, ' ');
  text += value.is_object() ? '{' : '[';
  const char* separator = "\n";
  for (const auto& [key, child] : value.items()) {
    const std::string name = value.is_object() ? scalar(key) + ": " : "";
    text += separator + margin + name;
    append(text, child, indent + 2, margin.size() + name.size());
    separator = ",\n";
  }
  text += '\n' + std::string(indent, ' ') + (value.is_object() ? '}' : ']');
}

}  // namespace

Document numberDocument(double value) {
  const bool whole = std::trunc(value) == value && std::abs(value) < 1e15;
  if (whole && !(value == 0 && std::signbit(value))) return static_cast<std::int64_t>(value);
  return value;
}

std::string format(const Document& document) {
  std::string text;
  append(text, document, 0, 0);
  return text + "\n";
}

}  // namespace burin::json
