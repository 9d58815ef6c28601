#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace burin::compositor::fuzz {

/// What a message turned out to carry.
struct Walked {
  std::size_t tiles = 0;
  std::size_t active = 0;  ///< pixels
  friend bool operator==(const Walked&, const Walked&) = default;
};

/// Decodes any bytes as fuzzed_frame.hpp says, then reads every pixel of every tile, folds it and
/// pastes it. @returns nullopt if decodeTiles() refused them with Error{kRank}. Throws
/// std::logic_error if what it accepted is no tile of the frame, and nothing else.
std::optional<Walked> walkTileMessage(std::span<const std::byte> input);

/// An input that is a whole message, to start from.
struct Seed {
  std::string name;
  std::vector<std::byte> bytes;
  Walked content;
};

/// Of every algebra: by value, packed, by reference packed and in place, aligned and not, and
/// nothing at all.
std::vector<Seed> tileMessageSeeds();

}  // namespace burin::compositor::fuzz
