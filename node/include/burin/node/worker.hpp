#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "burin/common/brick_tree.hpp"
#include "burin/common/communicator.hpp"
#include "burin/common/scene.hpp"
#include "burin/common/statistics.hpp"
#include "burin/compositor/subimage.hpp"
#include "burin/node/brick_source.hpp"
#include "burin/node/group_image.hpp"
#include "burin/node/offscreen_context.hpp"
#include "burin/node/step_map.hpp"
#include "burin/node/survey.hpp"
#include "burin/node/technique.hpp"

namespace burin::node {

class Brick;

struct WorkerOptions {
  int bricks = 0;    ///< bricks in all; 0: one per rank that renders
  bool skip = true;  ///< empty-space skipping
  bool countSamples = false;
  bool dedicatedHost = false;  ///< rank 0 gets no bricks
  /// Loads all of a brick, not only what the scene may show of it: no edit of transfer functions or
  /// clip planes then loads anything.
  bool wholeBricks = false;
  Technique technique = Technique::kRaycast;
  Precision precision = Precision::kFloat;  ///< kRaycast: must be kFloat
  GlBackend gl = GlBackend::kOsMesa;
  /// Views for which the bricks are to be balanced (the same on all ranks); others can be drawn as
  /// well. Empty: for none in particular.
  std::vector<Camera> views = {};
  /// Scenes that the worker may be updated to, resolved, the same on all ranks: what they need of
  /// the volume beside the first one's needs (gradients, the Laplacian, ghost layers) is measured
  /// and loaded with it.
  std::vector<Scene> foreseen = {};
  /// The label volume (checkLabelVolume), which must still be there for updates; needed for scenes
  /// with layers that are bound to labels.
  BrickSource* labels = nullptr;
  /// Of the volume: spares the worker a survey of its own, if the first scene and the foreseen ones
  /// need no more. Is not looked at any more when the worker is made.
  const KnownSurvey* survey = nullptr;
  /// Overrides what the scene's styles declare: tests show with it that the declaration is needed.
  std::optional<int> ghostLayers = std::nullopt;
};

/// One rank's share of the renderer, alive across frames: its bricks' textures, its GL context and
/// programs, and the tree that all ranks agree on.
class Worker {
 public:
  /// Collective. Surveys the volume, splits it, loads what the scene may show of this rank's bricks
  /// (also without skipping: the same textures, so the same picture). A rank of whose bricks
  /// nothing shows has no OpenGL context. `scene` must be resolved. Throws CollectiveError, also if
  /// the scene cannot be drawn by that technique (checkTechnique).
  Worker(const Communicator& comm, const Scene& scene, BrickSource& source,
         const WorkerOptions& options);
  ~Worker();

  /// Collective. Draws this scene from now on, doing only what the change needs: values alone are
  /// uniforms; a transfer function is a new table and new occupancy; other styles are a program;
  /// more ghost layers, an operator's first gradients, the first Laplacian, parts that were not
  /// loaded because nothing showed there, or a split that has become bad mean that bricks are
  /// loaded again; other labels mean that the label volume is read again. `scene` must be resolved
  /// and of the same volume; the communicator and the source given at the start must still be
  /// there. Throws CollectiveError; the worker then draws what it drew before, or nothing if bricks
  /// were being loaded.
  void update(const Scene& scene);

  const VolumeSurvey& survey() const;  ///< without its blocks
  const BrickTree& tree() const;

  /// Ranks that own bricks of which something may show, front to back for this camera. The same on
  /// every rank.
  std::vector<Rank> visibilityOrder(const Camera& camera) const;

  /// Where a subimage's pixels go: memory for that many, which outlives the subimage.
  using PixelRoom = std::function<std::span<Rgba>(std::size_t pixels)>;

  /// Local. Draws this rank's bricks into one subimage (empty active rectangle if nothing is
  /// visible) and adds to the statistics. `steps` replaces the scene's step if given; its largest
  /// must be covered by the ghost layers that the scene asked for. `group`: which of the scene's
  /// layerGroups(), of media and surfaces. Throws Error{kRank} if GL fails.
  compositor::SubimageView<Rgba> draw(const Camera& camera, RankStatistics& statistics,
                                      const PixelRoom& room, const StepMap* steps = nullptr,
                                      std::size_t group = 0);
  /// The same, into memory of its own.
  compositor::Subimage<Rgba> draw(const Camera& camera, RankStatistics& statistics);

  /// Local. The same of groups that are projections, of mode kMip and kAverage.
  compositor::Subimage<compositor::LargestValuePixel> drawLargest(const Camera& camera,
                                                                  RankStatistics& statistics,
                                                                  std::size_t group);
  compositor::Subimage<compositor::WeightedSumPixel> drawSums(const Camera& camera,
                                                              RankStatistics& statistics,
                                                              std::size_t group);
  /// Local. The picture from the images of all groups of the scene, in their order: projections
  /// classified in double by their transfer functions (opacity as it is written), later images over
  /// earlier ones.
  Image<Rgba> merge(std::span<const GroupImage> images) const;

  /// Local. Draws one of this rank's bricks and nothing else: what a rank that owned just that one
  /// would draw. For measuring the parts of many ranks on one. Throws std::logic_error if this rank
  /// has no such brick, Error{kRank} if GL fails.
  compositor::SubimageView<Rgba> drawBrick(BrickId brick, const Camera& camera,
                                           RankStatistics& statistics, const PixelRoom& room);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace burin::node
