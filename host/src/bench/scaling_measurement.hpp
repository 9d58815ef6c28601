#pragma once

#include <glm/glm.hpp>
#include <string>

#include "burin/common/camera.hpp"
#include "burin/common/communicator.hpp"
#include "burin/host/scene_setup.hpp"

namespace burin::host::bench {

/// One row of scaling.csv: one scene on one number of ranks.
struct ScalingMeasurement {
  std::string kind;                          ///< "strong", "weak" or "lum-ma"
  bool isIsolated = true;                    ///< column "mode": isolated or wall
  int ranks = 0;                             ///< that draw
  double renderMaxMs = 0, renderMeanMs = 0;  ///< over the ranks
  double compositeMs = 0;                    ///< isolated: what the cost model predicts
  double frameMs = 0;
  std::string scene;
  ImageSize frame;
  glm::ivec3 dims{0};
  int repeats = 0;
  /// Slowest rank / mean.
  double imbalance() const { return renderMeanMs > 0 ? renderMaxMs / renderMeanMs : 1; }
};

/// Local; `self`: a communicator of this process alone. Draws each of `ranks` bricks by itself with
/// all threads, all of them in turns and `repeats` times (after one to warm up), as if each were
/// one rank's on a machine like this one; the medians count. Compositing is what the cost model
/// predicts for these subimages: their exact messages in burin's own schedule, replayed on a fast
/// link (compositor::assumedMachine) with the work measured here. frameMs = renderMaxMs +
/// compositeMs. `hasHost`: a rank that draws nothing collects the frame. Throws Error{kUsage} if
/// the volume cannot be cut into that many bricks; as Worker does. Sets neither kind nor scene.
ScalingMeasurement measureIsolated(const Communicator& self, PreparedScene& prepared, int ranks,
                                   bool hasHost, int repeats);

/// Collective over `comm`. Whole frames as `burin render` makes them, from a barrier to the frame
/// on rank 0; medians, compositeMs being what is left of the frame when the slowest rank has drawn.
/// Throws CollectiveError. Sets neither kind nor scene.
ScalingMeasurement measureWall(const Communicator& comm, PreparedScene& prepared, int repeats);

}  // namespace burin::host::bench
