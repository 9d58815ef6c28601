#pragma once

#include <bit>
#include <cmath>

#include "burin/common/error.hpp"
#include "burin/compositor/pixel_algebra.hpp"

namespace burin::compositor {

/// A ray's samples from one that enters a priority higher than any before to the next such one.
struct FlatRecord {
  float scale = 0;  ///< 1 - flatness of the entering sample: what is left of everything in front
  Rgba group;       ///< the samples by `over`
  friend bool operator==(const FlatRecord&, const FlatRecord&) = default;
};

/// The flat mode's records of a segment of a ray, by priority 0 … kPriorities - 1, ascending along
/// the ray as a record needs a priority higher than all before. Unused ones are zero.
template <std::size_t kPriorities>
struct FlatRecordsPixel {
  std::uint32_t used = 0;  ///< bit i: there is a record for priority i
  std::array<FlatRecord, kPriorities> records{};
  friend bool operator==(const FlatRecordsPixel&, const FlatRecordsPixel&) = default;
};

/// The flat mode: a sample that enters a higher priority than any before on the ray scales what
/// lies in front of it, colour and alpha, by 1 - flatness. Rautek, Bruckner & Gröller, "Semantic
/// Layers for Illustrative Volume Rendering", 2007. In sort-last rendering a segment cannot know
/// what was in front of it, so it keeps one record per priority it entered. Associative to the
/// rounding of `over`; scales and priorities exactly.
///
/// On the wire: `used` in as many bytes as it needs, lowest first, then the used records.
template <std::size_t kPriorities>
struct FlatRecords {
  static_assert(kPriorities >= 1 && kPriorities <= 32);
  using Pixel = FlatRecordsPixel<kPriorities>;
  static constexpr std::size_t kMaskBytes = (kPriorities + 7) / 8;
  static constexpr std::size_t kMinWireBytes = kMaskBytes;
  static constexpr std::size_t kMaxWireBytes = kMaskBytes + kPriorities * sizeof(FlatRecord);
  static constexpr bool kWireIsMemory = false;

  static constexpr Pixel identity() { return {}; }
  static constexpr bool isIdentity(const Pixel& pixel) { return pixel.used == 0; }

  /// The back's records that are no higher than the front's last enter nothing new: they join that
  /// one's group. The others stay records.
  static constexpr Pixel combine(const Pixel& front, const Pixel& back) {
    if (front.used == 0) return back;
    Pixel both = front;
    const auto last = static_cast<std::size_t>(std::bit_width(front.used)) - 1;
    forEachUsed(back.used, [&](std::size_t priority) {
      const FlatRecord& record = back.records[priority];
      if (priority <= last) {
        both.records[last].group = over(both.records[last].group, record.group);
      } else {
        both.records[priority] = record;
        both.used |= 1u << priority;
      }
    });
    return both;
  }

  static std::size_t store(const Pixel& pixel, std::span<std::byte> out) {
    std::size_t length = 0;
    while (length < kMaskBytes) {
      out[length] = static_cast<std::byte>((pixel.used >> (8 * length)) & 0xffu);
      ++length;
    }
    forEachUsed(pixel.used, [&](std::size_t priority) {
      std::memcpy(&out[length], &pixel.records[priority], sizeof(FlatRecord));
      length += sizeof(FlatRecord);
    });
    return length;
  }
  /// Priorities that do not exist and anything that is no number are damage.
  static std::size_t load(std::span<const std::byte> in, Pixel& into) {
    if (in.size() < kMaskBytes) return 0;
    into = {};
    std::size_t length = 0;
    for (; length < kMaskBytes; ++length) {
      into.used |= std::to_integer<std::uint32_t>(in[length]) << (8 * length);
    }
    const bool isKnown = std::uint64_t{into.used} < std::uint64_t{1} << kPriorities;
    const auto records = static_cast<std::size_t>(std::popcount(into.used));
    if (!isKnown || in.size() < length + records * sizeof(FlatRecord)) return 0;
    bool isNumber = true;
    forEachUsed(into.used, [&](std::size_t priority) {
      FlatRecord& record = into.records[priority];
      std::memcpy(&record, &in[length], sizeof(FlatRecord));
      length += sizeof(FlatRecord);
      // A sum is NaN if a term is, or for opposite infinities, which are no colours either.
      const Rgba& c = record.group;
      isNumber = isNumber && !std::isnan(record.scale + c.r + c.g + c.b + c.a);
    });
    return isNumber ? length : 0;
  }

  /// The segment of one sample: the highest priority of a style that shows there, `flatness` in
  /// [0, 1] at the sample. A sample without opacity has no priority and is nothing.
  static Pixel sample(std::size_t priority, float flatness, const Rgba& colour) {
    BURIN_CHECK(priority < kPriorities);
    Pixel pixel;
    if (colour.a == 0) return pixel;
    pixel.used = 1u << priority;
    pixel.records[priority] = {1.0f - flatness, colour};
    return pixel;
  }

  /// The colour of a whole ray.
  static constexpr Rgba flatten(const Pixel& ray) {
    Rgba sum;
    forEachUsed(ray.used, [&](std::size_t priority) {
      const auto& [scale, group] = ray.records[priority];
      sum = over({scale * sum.r, scale * sum.g, scale * sum.b, scale * sum.a}, group);
    });
    return sum;
  }

 private:
  template <typename Use>
  static constexpr void forEachUsed(std::uint32_t used, Use&& use) {
    for (std::size_t priority = 0; priority < kPriorities && used != 0; ++priority, used >>= 1) {
      if ((used & 1u) != 0) use(priority);
    }
  }
};
static_assert(sizeof(FlatRecord) == 5 * sizeof(float), "padding would go onto the wire");
static_assert(PixelAlgebra<FlatRecords<4>>);

}  // namespace burin::compositor
