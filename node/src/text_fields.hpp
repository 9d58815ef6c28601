#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "burin/common/error.hpp"

namespace burin::node {

inline constexpr std::string_view kWhiteSpace = " \t\r\n\f\v";

/// Without white space at its ends.
std::string_view trimmed(std::string_view text);

/// The words between white space.
std::vector<std::string_view> words(std::string_view text);

/// The whole of `word` as a number, or nothing.
template <typename Number>
std::optional<Number> numberIn(std::string_view word) {
  Number value{};
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Exactly `count` numbers. Throws Error{kVolume} that names file and key.
template <typename Number>
std::vector<Number> numbersIn(std::string_view file, std::string_view key, std::string_view text,
                              std::size_t count) {
  std::vector<Number> numbers;
  for (const std::string_view word : words(text)) {
    if (const auto number = numberIn<Number>(word)) numbers.push_back(*number);
  }
  if (numbers.size() != count || words(text).size() != count) {
    fail(ExitCode::kVolume, "{}: {} \"{}\" (expected {} number{})", file, key,
         trimmed(text).substr(0, 80), count, count == 1 ? "" : "s");
  }
  return numbers;
}

template <typename Number>
Number numberIn(std::string_view file, std::string_view key, std::string_view text) {
  return numbersIn<Number>(file, key, text, 1).front();
}

}  // namespace burin::node
