#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "burin/compositor/flat_records.hpp"
#include "burin/compositor/nearest.hpp"
#include "burin/compositor/over_half.hpp"
#include "burin/compositor/product.hpp"
#include "burin/compositor/region.hpp"
#include "burin/compositor/shared_spaces.hpp"
#include "burin/compositor/silhouette.hpp"
#include "burin/compositor/silhouette_depth.hpp"

/// What a fuzzed message is decoded for: the frame, the memories it may refer to, and what its
/// first byte chooses.
namespace burin::compositor::fuzz {

/// Tiles of every awkward shape; the last has as many places as 16 bits can number.
inline constexpr std::array<PixelRect, 5> kTiles{{{256, 0, 272, 8},
                                                  {256, 8, 261, 11},
                                                  {256, 16, 257, 23},
                                                  {264, 16, 264 + 7, 17},
                                                  {0, 0, 256, 256}}};
inline constexpr ImageSize kFrame{272, 256};
inline constexpr Region kRegion{10, 10 + kTiles.size()};
inline const PixelRect& rectOf(std::size_t position) {
  return kTiles[position - kRegion.begin];
}

/// Ranks 1 and 3 share memory, the others nothing. On the heap and of odd lengths, so that the
/// address sanitizer sees a read beyond the end.
class FuzzedMemory {
 public:
  FuzzedMemory() : large_(400'001), small_(99) { fill(large_), fill(small_); }
  std::span<std::byte> large() { return large_; }
  SharedSpaces spaces() const { return SharedSpaces{{{}, large_, {}, small_}}; }

 private:
  static void fill(std::span<std::byte> bytes) {
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * 37 >> 3);
  }
  std::vector<std::byte> large_, small_;
};

/// The first byte of an input; the message follows.
struct Choice {
  std::uint8_t algebra = 0;   ///< see withAlgebra()
  bool hasSpaces = false;     ///< FuzzedMemory can be referred to
  bool isMisaligned = false;  ///< the message begins at an odd address

  static Choice of(std::byte first) {
    const auto bits = std::to_integer<std::uint8_t>(first);
    return {static_cast<std::uint8_t>(bits & 7u), (bits & 8u) != 0, (bits & 16u) != 0};
  }
  std::byte byte() const {
    return static_cast<std::byte>(algebra | (hasSpaces ? 8u : 0u) | (isMisaligned ? 16u : 0u));
  }
};

using Layered = Product<Channel<"beauty", Over>, Channel<"silhouette", Silhouette>,
                        Channel<"flat", FlatRecords<2>>>;
using Deep = Product<Channel<"beauty", Over>, Channel<"nearest", Nearest>>;
inline constexpr std::uint8_t kAlgebras = 8;

/// Calls `use.template operator()<A>()` for algebra number `algebra` of kAlgebras: pixels that
/// travel as they lie in memory, pixels of fixed and of variable length, and products of them.
template <typename Use>
auto withAlgebra(std::uint8_t algebra, Use&& use) {
  switch (algebra) {
    case 0:
      return use.template operator()<Over>();
    case 1:
      return use.template operator()<OverHalf>();
    case 2:
      return use.template operator()<Nearest>();
    case 3:
      return use.template operator()<Silhouette>();
    case 4:
      return use.template operator()<SilhouetteDepth>();
    case 5:
      return use.template operator()<FlatRecords<4>>();
    case 6:
      return use.template operator()<Layered>();
    default:
      return use.template operator()<Deep>();
  }
}

}  // namespace burin::compositor::fuzz
