#include <algorithm>
#include <optional>

#include "burin/compositor/compositor.hpp"
#include "burin/compositor/over_half.hpp"
#include "burin/host/frame_maker.hpp"
#include "burin/node/worker.hpp"
#include "step_choice.hpp"

namespace burin::host {

namespace {

class RaycastFrames : public FrameMaker {
 public:
  RaycastFrames(const Communicator& comm, PreparedScene& prepared,
                const node::WorkerOptions& options, const MergeOptions& merge)
      : comm_{comm},
        maxError_{prepared.scene.quality.maxError},
        isAdaptive_{prepared.scene.quality.preintegrated},
        compositor_{comm},
        worker_{comm, withTermination(prepared.scene), *prepared.source,
                workerOptions(prepared, options)},
        groups_{groupModes(prepared.scene)},
        merge_{merge} {}

  void update(const Scene& scene) override {
    worker_.update(withTermination(scene));
    maxError_ = scene.quality.maxError;
    isAdaptive_ = scene.quality.preintegrated;
    groups_ = groupModes(scene);
  }

  ImageView<const Rgba> make(const Camera& camera, RankStatistics& statistics) override {
    if (groups_.size() > 1 || isProjection(groups_.front())) return drawGroups(camera, statistics);
    if (!maxError_ || isAdaptive_) return draw(camera, statistics, nullptr);
    node::StepMap steps;
    {
      const PhaseTimer timer{statistics.phases, Phase::kUpdate};
      steps = chooseSteps(comm_, camera, *maxError_ - terminationOf(*maxError_),
                          [&](const Camera& small, const node::StepMap& probe) {
                            RankStatistics probing;
                            const ImageView<const Rgba> frame = draw(small, probing, &probe);
                            statistics.samplesVisited += probing.samplesVisited;
                            return frame;
                          });
    }
    return draw(camera, statistics, &steps);
  }

  CompositeStatistics lastComposite() const override {
    const compositor::FramePlan& plan = compositor_.lastPlan();
    return {plan.participants.empty() ? "" : compositor::scheduleName(plan.schedule.kind),
            merge_.isHalfOnWire ? "half" : "float", static_cast<int>(plan.participants.size()),
            compositor_.hosts().hosts(),
            compositor_.isPacking() && compositor_.hosts().hosts() > 1};
  }

 private:
  static Scene withTermination(Scene scene) {
    if (!scene.quality.maxError) return scene;
    scene.quality.termination = terminationOf(*scene.quality.maxError);
    scene.quality.stepVoxels = 1;  // what the march begins with
    return scene;
  }

  /// Of each of the scene's groups its first layer's.
  static std::vector<LayerMode> groupModes(const Scene& scene) {
    std::vector<LayerMode> modes;
    for (const Scene& group : layerGroups(scene)) modes.push_back(group.layers.front().mode);
    return modes;
  }

  /// Each group is an image and a composite of its own; rank 0 puts them over one another.
  ImageView<const Rgba> drawGroups(const Camera& camera, RankStatistics& statistics) {
    std::vector<node::GroupImage> images;
    std::int64_t activePixels = 0;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (groups_[i] == LayerMode::kMip) {
        images.emplace_back(project<compositor::LargestValue>(
            camera, statistics, [&] { return worker_.drawLargest(camera, statistics, i); }));
      } else if (groups_[i] == LayerMode::kAverage) {
        images.emplace_back(project<compositor::WeightedSum>(
            camera, statistics, [&] { return worker_.drawSums(camera, statistics, i); }));
      } else {
        images.emplace_back(copyOf(draw(camera, statistics, nullptr, i)));
      }
      activePixels += statistics.activePixels;
    }
    statistics.activePixels = activePixels;
    if (!comm_.isRoot()) return {};
    const PhaseTimer timer{statistics.phases, Phase::kFinish};
    frame_ = worker_.merge(images);
    return frame_;
  }

  template <typename Pixel>
  static Image<Pixel> copyOf(const ImageView<const Pixel>& view) {
    Image<Pixel> image{view.size()};
    std::ranges::copy(view.pixels(), image.pixels().begin());
    return image;
  }

  /// Collective. `drawMine`: a subimage of A's pixels.
  template <compositor::PixelAlgebra A, typename Draw>
  Image<typename A::Pixel> project(const Camera& camera, RankStatistics& statistics,
                                   const Draw& drawMine) {
    compositor::Subimage<typename A::Pixel> mine{camera.image, {}, {}};
    Outcome drawing;
    {
      const PhaseTimer timer{statistics.phases, Phase::kDraw};
      drawing = attempt([&] { mine = drawMine(); });
    }
    const auto merged = compositor_.toRoot<A>(merge_.composite, worker_.visibilityOrder(camera),
                                              mine, std::move(drawing), statistics);
    return merged ? copyOf(*merged) : Image<typename A::Pixel>{};
  }

  ImageView<const Rgba> draw(const Camera& camera, RankStatistics& statistics,
                             const node::StepMap* steps, std::size_t group = 0) {
    compositor::SubimageView<Rgba> mine{camera.image, {}, {}};
    Outcome drawing;
    {
      const PhaseTimer timer{statistics.phases, Phase::kDraw};
      // Pixels are read back to where the other ranks of the host read them.
      drawing = attempt([&] {
        mine = worker_.draw(
            camera, statistics,
            [&](std::size_t pixels) { return compositor_.canvas<Rgba>(camera.image, pixels); },
            steps, group);
      });
    }
    const auto order = worker_.visibilityOrder(camera);
    const auto merged = merge_.isHalfOnWire
                            ? compositor_.toRoot<compositor::OverHalf>(
                                  merge_.composite, order, mine, std::move(drawing), statistics)
                            : compositor_.toRoot<compositor::Over>(merge_.composite, order, mine,
                                                                   std::move(drawing), statistics);
    return merged.value_or(ImageView<const Rgba>{});
  }

  const Communicator& comm_;
  std::optional<double> maxError_;
  bool isAdaptive_;
  compositor::Compositor compositor_;
  node::Worker worker_;
  std::vector<LayerMode> groups_;
  MergeOptions merge_;
  Image<Rgba> frame_;  ///< of several groups, on rank 0
};

}  // namespace

std::unique_ptr<FrameMaker> makeRaycastFrames(const Communicator& comm, PreparedScene& prepared,
                                              const node::WorkerOptions& options,
                                              const MergeOptions& merge) {
  return std::make_unique<RaycastFrames>(comm, prepared, options, merge);
}

}  // namespace burin::host
