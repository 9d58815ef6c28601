#include "number_pattern.hpp"

#include <fmt/format.h>

#include <charconv>

namespace burin::node {

std::string NumberPattern::name(long number) const {
  return fmt::format("{}{:0{}}{}", before, number, width, after);
}

std::optional<NumberPattern> parseNumberPattern(std::string_view text) {
  constexpr std::size_t kWidest = 20;
  const std::size_t at = text.find('%');
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t end = text.find_first_not_of("0123456789", at + 1);
  if (end == std::string_view::npos || text[end] != 'd') return std::nullopt;
  if (text.find('%', end) != std::string_view::npos) return std::nullopt;
  NumberPattern pattern{std::string{text.substr(0, at)}, 0, std::string{text.substr(end + 1)}};
  if (end > at + 1) {
    const auto result = std::from_chars(text.data() + at + 1, text.data() + end, pattern.width);
    if (result.ec != std::errc{} || pattern.width > kWidest) return std::nullopt;
  }
  return pattern;
}

}  // namespace burin::node
