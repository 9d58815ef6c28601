#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "burin/common/communicator.hpp"
#include "burin/common/statistics.hpp"
#include "burin/common/trace.hpp"
#include "burin/host/command_line.hpp"
#include "burin/host/display.hpp"
#include "burin/host/frame_maker.hpp"
#include "burin/host/progress.hpp"
#include "burin/host/scene_setup.hpp"

namespace burin::host {

/// The loop that all ranks run through a `burin render`: one scene, one volume, any number of
/// frames. Rank 0 has the Display besides. Everything here is collective.
class Session {
 public:
  /// Checks that the output can be written, reads scene and volume, loads the bricks. Throws
  /// SharedError or CollectiveError, on all ranks.
  Session(const Communicator& comm, const RenderOptions& options);

  /// Draws and writes all frames, then the statistics. Returns the exit code: 0, or 128 + the
  /// signal that ended the run after a whole frame. Throws like the constructor.
  int run();

 private:
  double orbitDeg(int index) const;
  std::vector<Camera> someViews() const;
  void checkTechnique() const;
  void checkCameras() const;
  std::unique_ptr<FrameMaker> makeFrameMaker();
  /// The signal that some rank got, in which case the frame was dropped, or 0.
  int runFrame(int index);
  /// Whether the frame of that orbit angle is the one that is there. The same on every rank.
  bool isThere(double orbit) const;
  Outcome draw(int index, FrameStatistics& frame, RankStatistics& mine);
  void writeFrame(int index, FrameStatistics& frame);
  void reportResult() const;

  const Communicator& comm_;
  const RenderOptions& options_;
  std::optional<TraceRecording> trace_;
  Progress progress_;
  PreparedScene prepared_;
  std::unique_ptr<FrameMaker> frames_;
  std::optional<Display> display_;  ///< on rank 0
  std::optional<double> drawnDeg_;  ///< orbit angle of the last frame
  RankStatistics drawn_;            ///< of the last frame that was drawn
  RunStatistics statistics_;
};

}  // namespace burin::host
