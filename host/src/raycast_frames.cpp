#include "burin/compositor/composite.hpp"
#include "burin/host/frame_maker.hpp"
#include "burin/node/worker.hpp"

namespace burin::host {

namespace {

class RaycastFrames : public FrameMaker {
 public:
  RaycastFrames(const Communicator& comm, PreparedScene& prepared,
                const node::WorkerOptions& options)
      : comm_{comm}, worker_{comm, prepared.scene, *prepared.source, options} {}

  Image<Rgba> make(const Camera& camera, RankStatistics& statistics) override {
    compositor::Subimage<Rgba> mine{camera.image, {}, {}};
    Outcome drawing;
    {
      const PhaseTimer timer{statistics.phases[Phase::kDraw]};
      drawing = attempt([&] {
        mine = worker_.draw(camera, statistics);
        compositor::trim<compositor::Over>(mine);
      });
      statistics.activePixels = static_cast<std::int64_t>(mine.active.pixels());
    }
    auto frame = compositor::compositeToRoot<compositor::Over>(
        comm_, compositor::CompositeOptions{}, worker_.visibilityOrder(camera), std::move(mine),
        std::move(drawing), statistics);
    return frame ? std::move(*frame) : Image<Rgba>{};
  }

 private:
  const Communicator& comm_;
  node::Worker worker_;
};

}  // namespace

std::unique_ptr<FrameMaker> makeRaycastFrames(const Communicator& comm, PreparedScene& prepared,
                                              const node::WorkerOptions& options) {
  return std::make_unique<RaycastFrames>(comm, prepared, options);
}

}  // namespace burin::host
