#pragma once

#include <vector>

#include "bench/compositing_input.hpp"

namespace burin::host::bench {

/// Collective. The scenes of `burin bench accuracy`: the built-in ones that other benchmarks have
/// too, and one with two layers and lines unless quick is asked for; or the one that is given.
std::vector<NamedScene> accuracyScenes(const Communicator& comm,
                                       const BenchAccuracyOptions& options);

}  // namespace burin::host::bench
