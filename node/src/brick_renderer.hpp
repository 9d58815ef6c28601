#pragma once

#include <functional>
#include <span>
#include <vector>

#include "brick.hpp"
#include "burin/common/camera.hpp"
#include "burin/common/image.hpp"
#include "burin/common/scene.hpp"
#include "burin/common/statistics.hpp"
#include "burin/compositor/subimage.hpp"
#include "burin/node/step_map.hpp"
#include "label_masks.hpp"

namespace burin::node {

/// Where that many pixels go.
using PixelRoom = std::function<std::span<Rgba>(std::size_t pixels)>;

struct DrawOptions {
  bool skip = true;
  bool countSamples = false;
  bool severalBricks = false;  ///< draw() may get more than one, which hide one another
};

/// Draws a volume's bricks by some technique. Holds the programs of the current scene, its transfer
/// functions and the target. Its OffscreenContext must be current.
class BrickRenderer {
 public:
  virtual ~BrickRenderer() = default;

  /// Draws this scene from now on (same volume). Programs are kept: going back to a set of styles
  /// compiles nothing. If it throws, the scene before stays. `masks`: those of the bricks, in which
  /// there may be other layers' as well.
  virtual void setScene(const Scene& scene, const LabelMasks& masks) = 0;

  /// What the scene's transfer functions take.
  virtual std::size_t tableBytes() const = 0;

  /// Draws `bricks`, given front to back, into one subimage. Adds the sample counters to
  /// `statistics` if they are counted. `steps` replaces the scene's step if given.
  virtual compositor::SubimageView<Rgba> draw(const Camera& camera,
                                              std::span<const Brick* const> bricks,
                                              RankStatistics& statistics, const PixelRoom& room,
                                              const StepMap* steps) = 0;
};

/// A brick that may show something, and the pixels where.
struct BrickJob {
  const Brick* brick;
  PixelRect pixels;
};

/// Those of `bricks` that this view may show, in their order. `skip`: only their visible cells
/// count.
std::vector<BrickJob> brickJobs(const Camera& camera, const VolumeGrid& grid,
                                std::span<const Brick* const> bricks, bool skip);
/// Around all of them.
PixelRect activeArea(std::span<const BrickJob> jobs);
/// The steps of a job: the scene's, or those of the map's tiles.
std::vector<StepRun> stepRuns(const BrickJob& job, double stepVoxels, const StepMap* steps);

}  // namespace burin::node
