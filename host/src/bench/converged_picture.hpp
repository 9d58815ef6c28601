#pragma once

#include "burin/common/communicator.hpp"
#include "burin/common/image.hpp"
#include "burin/host/scene_setup.hpp"

namespace burin::host::bench {

/// Collective. What every way of drawing the scene converges to, on rank 0: the double-precision
/// reference, which cuts rays where the volume has kinks and divides the pieces until no pixel is
/// further than about `allowed` from the integral. Replaces the scene's quality.
Image<Rgba> convergedPicture(const Communicator& comm, PreparedScene& prepared, double allowed,
                             const Camera& camera);

}  // namespace burin::host::bench
