#pragma once

#include <functional>

#include "burin/common/camera.hpp"
#include "burin/common/communicator.hpp"
#include "burin/common/image.hpp"
#include "burin/node/step_map.hpp"

namespace burin::host {

/// Rays that end early may be wrong by their threshold: the part of a largest error that is left to
/// them, so that the steps have less of it.
constexpr double terminationOf(double maxError) {
  return maxError / 16;
}

/// Collective: draws a view with these steps, the frame on rank 0.
using DrawWithSteps =
    std::function<ImageView<const Rgba>(const Camera& camera, const node::StepMap& steps)>;

/// Collective. The steps that the tiles of a view need so that no pixel is further than `maxError`
/// from the converged picture: the view is drawn small at steps of 4, 2, 1, … voxels, each tile
/// until halving the step changes no pixel in or next to it by more than the bound allows. The same
/// on every rank; decided by pictures, which do not depend on bricks and ranks.
///
/// Halving the step changes a pixel by 1/2 (first order, at opaque surfaces) to 3/4 (second order)
/// of its error; the rest of a safety of 4 covers what the small picture's pixels miss. Whether the
/// bound holds was looked at on real volumes: host/README.md.
node::StepMap chooseSteps(const Communicator& comm, const Camera& camera, double maxError,
                          const DrawWithSteps& draw);

}  // namespace burin::host
