#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "burin/common/error.hpp"
#include "burin/host/command_line.hpp"

namespace burin::host {

namespace {

constexpr int kMostVoxelsPerAxis = 1 << 20;

/// The whole of `text` as a number, or nothing.
template <typename Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// `separator`: of the characters in it, the one that comes first stands in both places.
template <typename Number>
std::optional<std::array<Number, 3>> triple(std::string_view text, std::string_view separator) {
  std::array<Number, 3> values{};
  const std::size_t first = text.find_first_of(separator);
  if (first == std::string_view::npos) return std::nullopt;
  const char between = text[first];
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t comma = i < 2 ? text.find(between) : text.size();
    if (comma == std::string_view::npos) return std::nullopt;
    const auto value = number<Number>(text.substr(0, comma));
    if (!value) return std::nullopt;
    values[i] = *value;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return values;
}

}  // namespace

glm::ivec3 parseDims(const std::string& text, const std::string& option) {
  const auto values = triple<int>(text, ",xX");  // files are named by 256x256x128
  if (!values)
    fail(ExitCode::kUsage, "{} {}: expected X,Y,Z or XxYxZ, e.g. 256,256,128", option, text);
  for (const int value : *values) {
    if (value < 1 || value > kMostVoxelsPerAxis)
      fail(ExitCode::kUsage, "{} {}: each must be from 1 to {}", option, text, kMostVoxelsPerAxis);
  }
  return {(*values)[0], (*values)[1], (*values)[2]};
}

glm::dvec3 parseSpacing(const std::string& text, const std::string& option) {
  const auto values = triple<double>(text, ",");
  if (!values) fail(ExitCode::kUsage, "{} {}: expected X,Y,Z, e.g. 0.5,0.5,1.2", option, text);
  for (const double value : *values) {
    if (!std::isfinite(value) || value <= 0)
      fail(ExitCode::kUsage, "{} {}: each must be greater than 0", option, text);
  }
  return {(*values)[0], (*values)[1], (*values)[2]};
}

ImageSize parseSize(const std::string& text) {
  const std::size_t cross = text.find_first_of("xX");
  if (cross != std::string::npos) {
    const auto width = number<int>(std::string_view{text}.substr(0, cross));
    const auto height = number<int>(std::string_view{text}.substr(cross + 1));
    if (width && height) return {*width, *height};
  }
  fail(ExitCode::kUsage, "--size {}: expected WxH, e.g. 1024x768", text);
}

}  // namespace burin::host
