#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "burin/common/communicator.hpp"
#include "burin/common/image.hpp"
#include "burin/common/statistics.hpp"
#include "burin/host/command_line.hpp"
#include "burin/host/scene_setup.hpp"

namespace burin::host {

/// Is told the share of a frame's work that this rank has done, in [0, 1]. Called on every rank.
using ReportProgress = std::function<void(double)>;

/// How a frame comes about, on all ranks together. Lives across frames.
class FrameMaker {
 public:
  virtual ~FrameMaker() = default;

  /// Collective. Draws this scene from now on, doing what the change needs. `scene`: resolved, of
  /// the same volume. Throws CollectiveError as node::Worker::update does.
  virtual void update(const Scene& scene) = 0;

  /// Collective. The whole frame on rank 0, valid until the next call, no pixels elsewhere. Adds to
  /// the statistics' draw, composite and gather phases. Throws CollectiveError if a rank failed.
  virtual ImageView<const Rgba> make(const Camera& camera, RankStatistics& statistics) = 0;
  /// How the last frame was merged.
  virtual CompositeStatistics lastComposite() const { return {}; }
};

/// Collective. Bricks drawn by each rank's node::Worker, merged by a Compositor.
std::unique_ptr<FrameMaker> makeRaycastFrames(const Communicator& comm, PreparedScene& prepared,
                                              const node::WorkerOptions& options,
                                              const MergeOptions& merge);

/// Collective. Rows drawn by each rank's node::ReferenceRenderer. Rank 0 draws none if it is a
/// dedicated host.
std::unique_ptr<FrameMaker> makeReferenceFrames(const Communicator& comm, PreparedScene& prepared,
                                                const node::WorkerOptions& options,
                                                ReportProgress report);

}  // namespace burin::host
