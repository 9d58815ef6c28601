#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "burin/common/colour.hpp"
#include "burin/common/scene.hpp"

namespace burin {

/// Smallest and largest number of a label; such numbers are exact as 32-bit floats.
inline constexpr int kLargestLabel = 1 << 24;

/// What a segmentation says of one of its labels.
struct LabelInfo {
  int value = 0;
  std::string name;
  std::optional<Colour> colour;
  int component = 0;  ///< of voxels with several: in which of them it is
  friend bool operator==(const LabelInfo&, const LabelInfo&) = default;
};

/// ITK-SNAP's label descriptions: lines of number, red, green, blue, alpha, visibility, visibility
/// of the mesh and the name in quotes; `#` begins a comment. `name` is what messages call the text.
/// Throws Error{kUsage}: "name:line: …".
std::vector<LabelInfo> parseLabelDescriptions(std::string_view text, std::string_view name);

/// The text of a file of them. Throws Error{kUsage}.
std::string readLabelDescriptions(const std::filesystem::path& file);

/// Replaces the names of labels in the scene's layers by their numbers. `volume` is what messages
/// call the label volume. Throws Error{kUsage} for a name that is not there, naming the nearest.
void resolveLabels(Scene& scene, std::span<const LabelInfo> labels, std::string_view volume);

}  // namespace burin
