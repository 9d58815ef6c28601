#include <cstdint>
#include <span>

#include "tile_messages.hpp"

/// What libFuzzer calls, again and again. -1: not worth keeping, nothing was chosen.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return -1;
  burin::compositor::fuzz::walkTileMessage(std::as_bytes(std::span{data, size}));
  return 0;
}
