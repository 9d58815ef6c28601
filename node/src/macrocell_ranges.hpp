#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace burin::node {

/// What a look-up may say in a part of the volume; lowest > highest where no voxel is finite.
struct ValueRange {
  float lowest, highest;
};

/// Octants of a macrocell, numbered x + 2 y + 4 z, each coordinate 0 or 1.
inline constexpr std::size_t kOctants = 8;
using OctantMask = std::uint8_t;  ///< a bit for each octant
inline constexpr OctantMask kAllOctants = 0xff;

/// The value of an R16 texel, by the expression of BrickTexture.
inline float storedValue(std::uint16_t texel) {
  constexpr float kUnit = 1.0f / 65535.0f;
  return static_cast<float>(texel) * kUnit;
}
inline float storedValue(float value) {
  return value;
}

/// The value ranges of macrocells and of their octants, in few bytes: a macrocell's as texels (of
/// 16 bits) or floats, an octant's as two steps of 4 bits into its macrocell's. All are rounded
/// outwards.
class MacrocellRanges {
 public:
  MacrocellRanges() = default;
  /// `isWhole`: values are those of R16 texels, multiples of 1 / 65535.
  MacrocellRanges(std::size_t macrocells, bool isWhole);

  /// By its octants'; once for each macrocell.
  void set(std::size_t macrocell, std::span<const ValueRange, kOctants> octants);

  /// Never narrower than what was set.
  ValueRange whole(std::size_t macrocell) const {
    return std::visit([&](const auto& limits) { return limits.at(macrocell); }, limits_);
  }

  /// Per macrocell its octants that may show something by `visible`: any(lowest, highest) says
  /// whether a value of a range shows, all(lowest, highest) whether it does in every part of it.
  template <typename Visible>
  std::vector<OctantMask> mark(const Visible& visible) const {
    std::vector<OctantMask> masks(octants_.size() / kOctants);
    std::visit(
        [&](const auto& limits) {
          for (std::size_t i = 0; i < masks.size(); ++i)
            masks[i] = maskOf(limits.at(i), octantsOf(i), visible);
        },
        limits_);
    return masks;
  }

  std::size_t bytes() const;

 private:
  template <typename Number>
  struct Limits {
    std::vector<Number> lowest, highest;
    ValueRange at(std::size_t i) const { return {storedValue(lowest[i]), storedValue(highest[i])}; }
  };
  using Octants = std::span<const std::uint8_t, kOctants>;

  Octants octantsOf(std::size_t macrocell) const {
    return std::span{octants_}.subspan(macrocell * kOctants).first<kOctants>();
  }

  template <typename Visible>
  static OctantMask maskOf(const ValueRange& whole, Octants octants, const Visible& visible) {
    if (whole.lowest > whole.highest || !visible.any(whole.lowest, whole.highest)) return 0;
    if (visible.all(whole.lowest, whole.highest)) return kAllOctants;
    unsigned mask = 0;
    for (std::size_t i = 0; i < kOctants; ++i) {
      const ValueRange range = octantRange(whole, octants[i]);
      mask |= static_cast<unsigned>(visible.any(range.lowest, range.highest)) << i;
    }
    return static_cast<OctantMask>(mask);
  }

  static constexpr unsigned kMostSteps = 15;
  static constexpr std::uint8_t kWholeRange = kMostSteps << 4 | kMostSteps;  ///< its macrocell's
  /// How far n steps go: quadratically, as most octants that differ from their macrocell are near
  /// one end of its range.
  static constexpr std::array<float, kMostSteps + 1> kParts = [] {
    std::array<float, kMostSteps + 1> parts{};
    for (unsigned n = 0; n <= kMostSteps; ++n)
      parts[n] = static_cast<float>(n * n) / static_cast<float>(kMostSteps * kMostSteps);
    return parts;
  }();

  /// So many steps down from the macrocell's highest value, or up from its lowest.
  static float below(const ValueRange& whole, unsigned steps) {
    return steps == kMostSteps ? whole.lowest
                               : whole.highest - (whole.highest - whole.lowest) * kParts[steps];
  }
  static float above(const ValueRange& whole, unsigned steps) {
    return steps == kMostSteps ? whole.highest
                               : whole.lowest + (whole.highest - whole.lowest) * kParts[steps];
  }
  static ValueRange octantRange(const ValueRange& whole, unsigned code) {
    return {below(whole, code >> 4), above(whole, code & 15u)};
  }
  static unsigned stepsTo(float part);
  static std::uint8_t octantCode(const ValueRange& whole, float perWidth, const ValueRange& octant);

  std::variant<Limits<std::uint16_t>, Limits<float>> limits_;
  std::vector<std::uint8_t> octants_;  ///< of macrocell i from 8 i on: steps down << 4 | steps up
};

}  // namespace burin::node
