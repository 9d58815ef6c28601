#pragma once

#include "burin/common/communicator.hpp"

namespace burin::test {

/// All ranks of the test program; valid while the tests run.
const Communicator& world();

}  // namespace burin::test
