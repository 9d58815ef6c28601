#pragma once

#include "burin/common/communicator.hpp"

namespace burin::compositor {

/// Collective. Bytes per second of the slowest link when every rank sends to the next one at the
/// same time; the same number on all ranks. Takes some 10 ms on a 100 Mbit/s network. A measured
/// time, so only what loses nothing may follow it.
double measureLink(const Communicator& comm);

}  // namespace burin::compositor
