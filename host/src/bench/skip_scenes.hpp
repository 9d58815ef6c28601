#pragma once

#include "burin/host/scene_setup.hpp"

namespace burin::host::bench {

/// Built-in scenes of `side`³ voxels in a square frame of twice that side; rays never end early, so
/// that skipping alone decides what is visited.

/// Local. makeBalls() with a thin, plain transfer function.
PreparedScene ballScene(int count, double fraction, int side);
/// Local. The procedural vessels, nearly opaque.
PreparedScene vesselScene(int side);

}  // namespace burin::host::bench
