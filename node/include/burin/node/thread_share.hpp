#pragma once

#include "burin/common/communicator.hpp"

namespace burin::node {

/// Collective. Threads for this rank to draw with: the CPUs of its affinity mask divided among the
/// `drawing` ranks of its host that have the same mask, at least 1. Warns (one rank per host) when
/// the launcher bound ranks to fewer CPUs than their share of the host.
int threadShare(const Communicator& comm, bool drawing);

}  // namespace burin::node
