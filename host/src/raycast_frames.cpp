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
        worker_{comm, withTermination(prepared.scene), *prepared.source, options},
        merge_{merge} {}

  void update(const Scene& scene) override {
    worker_.update(withTermination(scene));
    maxError_ = scene.quality.maxError;
    isAdaptive_ = scene.quality.preintegrated;
  }

  ImageView<const Rgba> make(const Camera& camera, RankStatistics& statistics) override {
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

  ImageView<const Rgba> draw(const Camera& camera, RankStatistics& statistics,
                             const node::StepMap* steps) {
    compositor::SubimageView<Rgba> mine{camera.image, {}, {}};
    Outcome drawing;
    {
      const PhaseTimer timer{statistics.phases, Phase::kDraw};
      // Pixels are read back to where the other ranks of the host read them.
      drawing = attempt([&] {
        mine = worker_.draw(
            camera, statistics,
            [&](std::size_t pixels) { return compositor_.canvas<Rgba>(camera.image, pixels); },
            steps);
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
  MergeOptions merge_;
};

}  // namespace

std::unique_ptr<FrameMaker> makeRaycastFrames(const Communicator& comm, PreparedScene& prepared,
                                              const node::WorkerOptions& options,
                                              const MergeOptions& merge) {
  return std::make_unique<RaycastFrames>(comm, prepared, options, merge);
}

}  // namespace burin::host
