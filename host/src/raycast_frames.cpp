#include "burin/compositor/compositor.hpp"
#include "burin/compositor/over_half.hpp"
#include "burin/host/frame_maker.hpp"
#include "burin/node/worker.hpp"

namespace burin::host {

namespace {

class RaycastFrames : public FrameMaker {
 public:
  RaycastFrames(const Communicator& comm, PreparedScene& prepared,
                const node::WorkerOptions& options, const MergeOptions& merge)
      : compositor_{comm},
        worker_{comm, prepared.scene, *prepared.source, options},
        merge_{merge} {}

  ImageView<const Rgba> make(const Camera& camera, RankStatistics& statistics) override {
    compositor::SubimageView<Rgba> mine{camera.image, {}, {}};
    Outcome drawing;
    {
      const PhaseTimer timer{statistics.phases[Phase::kDraw]};
      // Pixels are read back to where the other ranks of the host read them.
      drawing = attempt([&] {
        mine = worker_.draw(camera, statistics, [&](std::size_t pixels) {
          return compositor_.canvas<Rgba>(camera.image, pixels);
        });
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

  CompositeStatistics lastComposite() const override {
    const compositor::FramePlan& plan = compositor_.lastPlan();
    return {plan.participants.empty() ? "" : compositor::scheduleName(plan.schedule.kind),
            merge_.isHalfOnWire ? "half" : "float", static_cast<int>(plan.participants.size()),
            compositor_.hosts().hosts(),
            compositor_.isPacking() && compositor_.hosts().hosts() > 1};
  }

 private:
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
