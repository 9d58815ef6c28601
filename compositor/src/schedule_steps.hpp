#pragma once

#include "burin/compositor/schedule.hpp"

namespace burin::compositor {

/// Appends a step, unless there is nothing to send.
inline void send(Plan& plan, int peer, const Region& region) {
  if (!region.empty()) plan.steps.push_back({Step::Kind::kSend, peer, region, false});
}

/// Appends a step, unless there is nothing to receive.
inline void receive(Plan& plan, int peer, const Region& region, bool peerIsInFront) {
  if (!region.empty()) plan.steps.push_back({Step::Kind::kReceive, peer, region, peerIsInFront});
}

}  // namespace burin::compositor
