#include "burin/common/labels.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "burin/common/error.hpp"
#include "burin/common/nearest_name.hpp"
#include "text_file.hpp"

namespace burin {
namespace {

constexpr std::string_view kBlanks = " \t\r";

/// Takes the next word off the text; "" at its end.
std::string_view takeWord(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(kBlanks));
  text.remove_prefix(word.size());
  return word;
}

/// A number in [least, most], or nothing.
std::optional<double> numberIn(std::string_view word, double least, double most) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value >= least && value <= most ? std::optional{value} : std::nullopt;
}

/// IDX R G B A VIS MSH "LABEL", or nothing.
std::optional<LabelInfo> labelIn(std::string_view line) {
  constexpr double kMost = kLargestLabel;
  const auto value = numberIn(takeWord(line), -kMost, kMost);
  const auto red = numberIn(takeWord(line), 0, 255);
  const auto green = numberIn(takeWord(line), 0, 255);
  const auto blue = numberIn(takeWord(line), 0, 255);
  // What is shown is the scene's business.
  for (int i = 0; i < 3; ++i)
    if (!numberIn(takeWord(line), 0, kMost)) return std::nullopt;
  const std::size_t begin = line.find('"');
  const std::size_t end = line.rfind('"');
  if (!value || std::trunc(*value) != *value || !red || !green || !blue || begin == end)
    return std::nullopt;
  const auto channel = [](double x) { return static_cast<std::uint8_t>(std::lround(x)); };
  return LabelInfo{static_cast<int>(*value), std::string{line.substr(begin + 1, end - begin - 1)},
                   Colour{channel(*red), channel(*green), channel(*blue)}};
}

}  // namespace

std::vector<LabelInfo> parseLabelDescriptions(std::string_view text, std::string_view name) {
  std::vector<LabelInfo> labels;
  for (int number = 1; !text.empty(); ++number) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    std::string_view rest = line;
    const std::string_view first = takeWord(rest);
    if (first.empty() || first.starts_with('#')) continue;
    auto label = labelIn(line);
    if (!label)
      fail(ExitCode::kUsage,
           "{}:{}: expected number, red, green, blue, three more numbers and \"name\" (ITK-SNAP's "
           "label descriptions)",
           name, number);
    labels.push_back(std::move(*label));
  }
  return labels;
}

std::string readLabelDescriptions(const std::filesystem::path& file) {
  return readSmallFile(file, "the label descriptions");
}

void resolveLabels(Scene& scene, std::span<const LabelInfo> labels, std::string_view volume) {
  std::vector<std::string_view> names;
  for (const LabelInfo& label : labels) names.push_back(label.name);
  for (std::size_t i = 0; i < scene.layers.size(); ++i) {
    for (LabelName& label : scene.layers[i].labels) {
      const auto* name = std::get_if<std::string>(&label);
      if (name == nullptr) continue;
      const auto found = std::ranges::find(labels, *name, &LabelInfo::name);
      if (found != labels.end()) {
        label = found->value;
        continue;
      }
      const std::string known = nameSuggestion(*name, names);
      fail(ExitCode::kUsage, "layers[{}].labels: {} has no label '{}'; {}", i, volume, *name,
           known.empty() ? "it names none: give numbers, or a file of names" : known);
    }
  }
}

}  // namespace burin
