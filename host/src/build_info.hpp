#pragma once

#include <string>

#include "burin/common/communicator.hpp"

namespace burin::host {

/// Collective. What this program was built with, what it finds on this machine and where its limits
/// are, a line each; on rank 0. What is missing is said instead.
std::string buildInfo(const Communicator& comm);

}  // namespace burin::host
