#pragma once

#include "burin/host/scene_setup.hpp"

namespace burin::host::bench {

/// Collective. prepareScene() for benchmarks that draw and merge by themselves, without a
/// FrameMaker: they know one image of colours. Throws SharedError besides if layers are
/// projections, which are images and composites of their own.
PreparedScene prepareSingleImage(const Communicator& comm, const RenderOptions& options);

}  // namespace burin::host::bench
