#pragma once

#include <vector>

#include "burin/common/communicator.hpp"

namespace burin {

/// Collective. For every rank of `comm` the lowest rank of the host it runs on.
std::vector<int> hostsOf(const Communicator& comm);

}  // namespace burin
