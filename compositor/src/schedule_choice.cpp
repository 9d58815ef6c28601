#include "burin/compositor/schedule_choice.hpp"

#include <algorithm>
#include <cmath>

#include "burin/common/error.hpp"

namespace burin::compositor {

namespace {

constexpr int kMostOnOneHost = 64;

/// Counts do not tell how much of what was drawn overlaps. At least as much as fits the frame; and
/// as bricks of one volume do, a line of sight meets the cube root of them.
double guessedDepthComplexity(int participants, double activePixels, double framePixels) {
  const double n = participants;
  return std::clamp(activePixels / std::max(framePixels, 1.0), std::cbrt(n), n);
}

}  // namespace

Machine assumedMachine(LinkClass link, int cores) {
  constexpr double kPerCombinedPixel = 1.5e-9;  // over, four floats
  constexpr double kPerEncodedByte = 3e-10;     // a copy into the message and the check on arrival
  switch (link) {
    case LinkClass::kSharedMemory:
      return {{5e-6, 2e-6, 0.0, 0.0}, {kPerCombinedPixel, 0.0}, cores};
    case LinkClass::kFast:
      return {{3e-6, 1e-6, 0.0, 2e-10}, {kPerCombinedPixel, kPerEncodedByte}, cores};
    case LinkClass::kSlow:
      break;
  }
  // Between 100 Mbit/s (8e-8) and 1 Gbit/s (8e-9): bytes decide at either, not the latency.
  return {{1e-4, 1e-5, 0.0, 2.5e-8}, {kPerCombinedPixel, kPerEncodedByte}, cores};
}

ScheduleOptions chooseSchedule(int participants, std::size_t activePixelsTotal,
                               std::size_t framePixels, LinkClass link, std::size_t bytesPerPixel,
                               int cores) {
  BURIN_CHECK(participants >= 1);
  // Read in place, every pixel is touched once and nobody waits for a round: fastest in every case
  // measured (README). Beyond the counts where ranks share a host the model decides.
  if (link == LinkClass::kSharedMemory && participants <= kMostOnOneHost) {
    return {ScheduleKind::kDirectSend};
  }
  const Machine machine = assumedMachine(link, cores);
  const WireSize wire{static_cast<double>(bytesPerPixel), WireSize{}.bytesPerMessage};
  const auto total = static_cast<double>(activePixelsTotal);
  const double complexity =
      guessedDepthComplexity(participants, total, static_cast<double>(framePixels));
  ScheduleOptions best;
  double bestSeconds = INFINITY;
  for (const ScheduleKind kind : {ScheduleKind::kBinarySwap, ScheduleKind::kRadixK,
                                  ScheduleKind::kDirectSend, ScheduleKind::kSerialGather}) {
    const ScheduleOptions options{kind};
    const int pieces = pieceCount(options, participants);
    const Region all{0, static_cast<std::size_t>(pieces)};  // a piece is a position
    const double seconds =
        predictAlike(lazySchedule(options, participants, evenCuts(all.end, pieces)),
                     activePixels({participants, all, total / participants, complexity}), wire,
                     machine)
            .seconds();
    if (seconds < bestSeconds) {  // of equals the first: small counts have several kinds alike
      best = options;
      bestSeconds = seconds;
    }
  }
  return best;
}

}  // namespace burin::compositor
