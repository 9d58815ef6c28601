#pragma once

#include <cstddef>
#include <span>

#include "burin/common/communicator.hpp"

namespace burin::compositor {

/// Tags of the compositor's messages.
enum class Tag : int { kSwap = 1, kGather = 2 };

/// A message that has come.
struct Received {
  int peer = 0;  ///< participant
  Rank sender{0};
  std::span<const std::byte> bytes;  ///< stays until the frame is done
};

}  // namespace burin::compositor
