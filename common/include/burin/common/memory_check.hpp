#pragma once

#include <cstdint>
#include <string>

#include "burin/common/communicator.hpp"

namespace burin {

/// What a rank is about to allocate.
struct MemoryNeed {
  std::int64_t bytes = 0;
  std::string purpose;  ///< as it stands before "needs", e.g. "a picture of 9x9 pixels"
};

/// Collective. Throws CollectiveError{kRank} unless every rank's need fits into memoryRoom(), with
/// those of the other ranks of its host: a message with both numbers, where the system would let
/// processes allocate more than there is and kill one of them later.
void checkMemory(const Communicator& comm, const MemoryNeed& mine);

}  // namespace burin
