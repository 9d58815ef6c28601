#include "slicer_segments.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "text_fields.hpp"

namespace burin::node {
namespace {

constexpr std::string_view kPrefix = "Segment";

std::optional<Colour> colourIn(std::string_view text) {
  const std::vector<std::string_view> parts = words(text);
  if (parts.size() != 3) return std::nullopt;
  std::uint8_t channels[3]{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto part = numberIn<double>(parts[i]);
    if (!part || !(*part >= 0 && *part <= 1)) return std::nullopt;
    channels[i] = static_cast<std::uint8_t>(std::lround(255 * *part));
  }
  return Colour{channels[0], channels[1], channels[2]};
}

}  // namespace

std::vector<LabelInfo> slicerSegments(
    const std::vector<std::pair<std::string, std::string>>& keyValues) {
  std::map<int, std::map<std::string_view, std::string_view>> segments;  // their fields
  for (const auto& [key, value] : keyValues) {
    const std::size_t end = key.find('_');
    if (!key.starts_with(kPrefix) || end == std::string::npos) continue;
    const std::string_view number =
        std::string_view{key}.substr(kPrefix.size(), end - kPrefix.size());
    if (const auto segment = numberIn<int>(number))
      segments[*segment][std::string_view{key}.substr(end + 1)] = trimmed(value);
  }
  std::vector<LabelInfo> labels;
  for (auto& [number, fields] : segments) {
    const auto value = numberIn<int>(fields["LabelValue"]);
    if (!value) continue;
    labels.push_back({*value, std::string{fields["Name"]}, colourIn(fields["Color"]),
                      numberIn<int>(fields["Layer"]).value_or(0)});
  }
  return labels;
}

}  // namespace burin::node
