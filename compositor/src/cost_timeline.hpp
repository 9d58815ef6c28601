#pragma once

#include <algorithm>
#include <functional>
#include <queue>
#include <span>
#include <vector>

#include "burin/compositor/cost_model.hpp"

namespace burin::compositor {

/// A link that carries one message at a time.
class Link {
 public:
  /// Carries a message that is ready at `time`; returns when its last byte is through.
  double carry(const LogGP& network, double time, double bytes) {
    const double end = std::max(time, free_) + bytes * network.gapPerByte;
    free_ = std::max(end, std::max(time, free_) + network.gap);
    return end;
  }

 private:
  double free_ = 0.0;
};

/// The processors of all participants.
class Cores {
 public:
  explicit Cores(int count) : isShared_{count > 0} {
    for (int i = 0; i < count; ++i) free_.push(0.0);
  }
  /// Computes for `duration` from `time` on or as soon as a core is free; returns the end.
  double compute(double time, double duration) {
    if (!isShared_) return time + duration;
    const double end = std::max(time, free_.top()) + duration;
    free_.pop();
    free_.push(end);
    return end;
  }

 private:
  bool isShared_;
  std::priority_queue<double, std::vector<double>, std::greater<>> free_;
};

/// A finished piece on one of its owners.
struct FinishedPiece {
  double time = 0.0;
  double bytes = 0.0;
};

/// When the root, ready at `time`, has all `pieces`, which come in the order they were finished.
double gatherEnd(std::span<const FinishedPiece> pieces, double time, const Machine& machine,
                 Cores& cores);

/// What a processor does per message, on either side.
inline double handling(const Machine& machine, double bytes) {
  return machine.link.overhead + machine.compute.perEncodedByte * bytes;
}

inline double messageBytes(const WireSize& wire, double pixels) {
  return wire.bytesPerMessage + wire.bytesPerPixel * pixels;
}

}  // namespace burin::compositor
