#pragma once

#include <chrono>

#include "burin/common/communicator.hpp"

namespace burin {

/// How the steady clock of a rank stands to rank 0's.
struct ClockOffset {
  std::chrono::nanoseconds ahead{0};     ///< to be subtracted from the rank's times
  std::chrono::nanoseconds accuracy{0};  ///< the true value is no further off
};

/// Collective. This rank's offset. Rank 0 asks every rank for its time some times; of the quickest
/// answer the time is that of the middle, within half of what it took (Cristian, "Probabilistic
/// clock synchronization", Distributed Computing 3, 1989).
ClockOffset clockOffset(const Communicator& comm);

}  // namespace burin
