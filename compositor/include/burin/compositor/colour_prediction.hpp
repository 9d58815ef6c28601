#pragma once

#include <cstddef>
#include <span>

namespace burin::compositor {

/// Replaces float RGBA pixels by their difference to what the pixel before lets expect, before they
/// are packed: neighbours differ in opacity but hardly in hue, so of four numbers one is news.
/// Opacity is expected to stay; red to keep its ratio to opacity, green and blue theirs to red.
/// Exactly reversible whatever the bits: differences are of bit patterns, and both sides compute
/// the same expectation from pixels they both have. Local. `in` and `out`: equal sizes, any number
/// of pixels of 16 bytes (what is left over is copied); not overlapping.
void predictColours(std::span<const std::byte> in, std::span<std::byte> out);
/// The reverse.
void restoreColours(std::span<const std::byte> in, std::span<std::byte> out);

}  // namespace burin::compositor
