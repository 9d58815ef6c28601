#pragma once

#include "burin/common/communicator.hpp"
#include "burin/compositor/cost_model.hpp"

namespace burin::host::bench {

/// Collective; the LogGP parameters of the link between rank 0 and the last rank, as a rank sees
/// them that waits idly, the same on all ranks. Nothing else may use the link meanwhile. After
/// Culler, Liu, Martin, Yoshikawa, "Assessing Fast Network Interfaces", IEEE Micro 16 (1), 1996:
/// o from sending alone, L from a ping-pong, g from a flood of small messages; G from the times of
/// a long message and a longer one. Takes about 0.5 s at 100 Mbit/s.
compositor::LogGP measureLinkParameters(const Communicator& comm);

/// Collective. Processor cores that all ranks share, 0 if they are on several machines. Network
/// namespaces of one machine share its cores and its kernel's boot identity.
int sharedCores(const Communicator& comm);

}  // namespace burin::host::bench
