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
        compositor_{comm},
        worker_{comm, withTermination(prepared.scene), *prepared.source, options},
        merge_{merge} {}

  ImageView<const Rgba> make(const Camera& camera, RankStatistics& statistics) override {
    if (!maxError_) return draw(camera, statistics, nullptr);
    node::StepMap steps;
    {
      const PhaseTimer timer{statistics.phases[Phase::kUpdate]};
      steps = chooseSteps(comm_, camera, *maxError_ - termination(*maxError_),
                          [&](const Camera& small, const node::StepMap& probe) {
                            RankStatistics unused;
                            return draw(small, unused, &probe);
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
  /// Rays that end early may be wrong by their threshold, which the step then has less of.
  static double termination(double maxError) { return maxError / 8; }

  static Scene withTermination(Scene scene) {
    if (scene.quality.maxError) scene.quality.termination = termination(*scene.quality.maxError);
    return scene;
  }

  ImageView<const Rgba> draw(const Camera& camera, RankStatistics& statistics,
                             const node::StepMap* steps) {
    compositor::SubimageView<Rgba> mine{camera.image, {}, {}};
    Outcome drawing;
    {
      const PhaseTimer timer{statistics.phases[Phase::kDraw]};
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
