#pragma once

#include <span>

#include "burin/compositor/cost_model.hpp"
#include "burin/compositor/frame_trace.hpp"

namespace burin::compositor {

/// What a rank's work costs on one core, in seconds.
struct WorkRates {
  double perScannedPixel = 0.0;
  double perCombinedPixel = 0.0;  ///< for each active pixel read
  double perPastedPixel = 0.0;
  double perEncodedByte = 0.0;  ///< a copy into the message
  double perDecodedByte = 0.0;  ///< the checks on arrival
  double perPackedByte = 0.0;   ///< on top of encoding, per byte before packing
  double perUnpackedByte = 0.0;
};

/// A network and processors to replay frames on.
struct ReplayMachine {
  LogGP link;
  WorkRates work;
  int cores = 0;  ///< that all ranks share; 0: each has one of its own
  /// Longer messages leave only when the receiver waits for them and has said so (MPI's
  /// rendezvous).
  double eagerBytes = 65536.0;
};

/// Seconds from a common start until the last rank has ended its trace. Ranks follow their traces
/// as predict() lets participants follow a schedule, but every message has its exact bytes. Each
/// link carries one message at a time. Throws Error (a check) if traces do not match.
double replay(std::span<const FrameTrace> byRank, const ReplayMachine& machine);

}  // namespace burin::compositor
