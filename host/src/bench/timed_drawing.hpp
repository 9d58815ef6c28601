#pragma once

#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/common/statistics.hpp"
#include "burin/host/scene_setup.hpp"
#include "burin/node/worker.hpp"

namespace burin::host::bench {

/// A scene drawn by all ranks again and again, one brick each and nothing merged: what drawing
/// alone takes.
class TimedDrawing {
 public:
  /// Collective. `prepared` and `comm` outlive this.
  TimedDrawing(const Communicator& comm, PreparedScene& prepared,
               const node::WorkerOptions& options)
      : TimedDrawing{comm, prepared, prepared.scene, options} {}
  /// The same for another scene (resolved) of that volume.
  TimedDrawing(const Communicator& comm, PreparedScene& prepared, const Scene& scene,
               const node::WorkerOptions& options);

  /// Collective. Milliseconds of one frame, the slowest rank's; of pixels read back into memory
  /// that has been used before. Throws CollectiveError if drawing failed on a rank.
  double drawMs();

  /// Collective. The same for a frame of another scene (of the same volume), changing to it
  /// included.
  double editMs(const Scene& scene);

  /// Collective. The sample counters of one frame, over all ranks; zeros without
  /// WorkerOptions::countSamples.
  RankStatistics count();

  const node::Worker& worker() const { return worker_; }
  const Camera& camera() const { return camera_; }

 private:
  double drawOnce(RankStatistics& statistics, const Scene* changed = nullptr);

  const Communicator& comm_;
  Camera camera_;
  node::Worker worker_;
  std::vector<Rgba> room_;
};

}  // namespace burin::host::bench
