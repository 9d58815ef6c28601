#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/compositing_input.hpp"
#include "bench/contender.hpp"
#include "bench/frame_model.hpp"

namespace burin::host::bench {

/// One row of compositing.csv: one contender on one input.
struct CompositingMeasurement {
  std::string peer;
  std::string schedule;
  int ranks = 0;
  ImageSize frame;
  double activeFraction = 0;
  std::string input;  ///< column "case"
  int repeats = 0;
  /// From a barrier to the frame on rank 0, the slowest rank's.
  double medianMs = 0, smallestMs = 0, largestMs = 0;
  /// Sent by all ranks together, without and with the collect to rank 0.
  std::int64_t bytesCompose = 0, bytesTotal = 0;
  double modelledMs = 0;    ///< what the model predicts; 0: not modelled
  double largestError = 0;  ///< of any channel, to the exact frame
};

/// Collective over `comm`, of which the contenders are. Every contender composites the input
/// `repeats` times, all of them in turns and each round starting with another one, so that what
/// else the machine does meets them alike; before that once each without and with the collect, to
/// warm up, for the bytes and for the error, and to predict the time with `model`. Rank 0 gets the
/// measurements, in the order of the contenders; the other ranks ones whose error is 0.
std::vector<CompositingMeasurement> measureCompositing(const Communicator& comm,
                                                       std::span<const Contenders> peers,
                                                       const CompositingInput& input,
                                                       const FrameModel& model, int repeats);

}  // namespace burin::host::bench
