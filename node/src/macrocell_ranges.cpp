#include "macrocell_ranges.hpp"

#include <algorithm>
#include <limits>

namespace burin::node {
namespace {

constexpr std::uint16_t kMostTexel = 65535;

/// The nearest texels whose values are not above, or not below, a value in [0, 1].
std::uint16_t texelBelow(float value) {
  auto texel = static_cast<std::uint16_t>(value * float{kMostTexel});
  if (texel < kMostTexel) ++texel;
  while (texel > 0 && storedValue(texel) > value) --texel;
  return texel;
}
std::uint16_t texelAbove(float value) {
  auto texel = static_cast<std::uint16_t>(value * float{kMostTexel});
  if (texel > 0) --texel;
  while (texel < kMostTexel && storedValue(texel) < value) ++texel;
  return texel;
}

}  // namespace

MacrocellRanges::MacrocellRanges(std::size_t macrocells, bool isWhole)
    : octants_(macrocells * kOctants, kWholeRange) {
  if (isWhole) {
    limits_.emplace<Limits<std::uint16_t>>(Limits<std::uint16_t>{
        std::vector<std::uint16_t>(macrocells, 1), std::vector<std::uint16_t>(macrocells, 0)});
    return;
  }
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  limits_.emplace<Limits<float>>(Limits<float>{std::vector<float>(macrocells, kInfinity),
                                               std::vector<float>(macrocells, -kInfinity)});
}

/// The fewest steps that go as far as a part, up to 1, of a range; up to rounding.
inline unsigned MacrocellRanges::stepsTo(float part) {
  constexpr unsigned kUnits = kMostSteps * kMostSteps;  // n steps are n^2 of them
  static constexpr std::array<std::uint8_t, kUnits + 1> kSteps = [] {
    std::array<std::uint8_t, kUnits + 1> steps{};
    for (unsigned units = 0, n = 0; units <= kUnits; ++units) {
      if (units > n * n) ++n;
      steps[units] = static_cast<std::uint8_t>(n);
    }
    return steps;
  }();
  const float units = part * static_cast<float>(kUnits);
  const int whole = static_cast<int>(units);
  const int ceiled = whole + (units > static_cast<float>(whole) ? 1 : 0);
  return kSteps[static_cast<std::size_t>(std::min(ceiled, static_cast<int>(kUnits)))];
}

/// The smallest range of the codes' that holds the octant's, by the very expressions that decode
/// it. For an octant without finite voxels the one whose ends are crossed: what does not show all
/// of the macrocell's values shows none of it.
inline std::uint8_t MacrocellRanges::octantCode(const ValueRange& whole, float perWidth,
                                                const ValueRange& octant) {
  if (octant.lowest > octant.highest) return 0;
  unsigned down = stepsTo((whole.highest - octant.lowest) * perWidth);
  while (down < kMostSteps && below(whole, down) > octant.lowest) ++down;
  unsigned up = stepsTo((octant.highest - whole.lowest) * perWidth);
  while (up < kMostSteps && above(whole, up) < octant.highest) ++up;
  return static_cast<std::uint8_t>(down << 4 | up);
}

void MacrocellRanges::set(std::size_t macrocell, std::span<const ValueRange, kOctants> octants) {
  ValueRange range = octants[0];
  for (const ValueRange& octant : octants)
    range = {std::min(range.lowest, octant.lowest), std::max(range.highest, octant.highest)};
  if (range.lowest > range.highest) return;
  if (auto* texels = std::get_if<Limits<std::uint16_t>>(&limits_)) {
    texels->lowest[macrocell] = texelBelow(range.lowest);
    texels->highest[macrocell] = texelAbove(range.highest);
  } else {
    auto& floats = std::get<Limits<float>>(limits_);
    floats.lowest[macrocell] = range.lowest;
    floats.highest[macrocell] = range.highest;
  }
  const ValueRange rounded = whole(macrocell);
  const float width = rounded.highest - rounded.lowest;
  if (width < std::numeric_limits<float>::min()) return;
  for (std::size_t i = 0; i < kOctants; ++i)
    octants_[macrocell * kOctants + i] = octantCode(rounded, 1.0f / width, octants[i]);
}

std::size_t MacrocellRanges::bytes() const {
  const std::size_t limits = std::visit(
      [](const auto& all) { return 2 * all.lowest.size() * sizeof(all.lowest.front()); }, limits_);
  return limits + octants_.size();
}

}  // namespace burin::node
