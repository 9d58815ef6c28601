#include <algorithm>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "bench/median.hpp"
#include "bench/scaling_measurement.hpp"
#include "bench/work_rates.hpp"
#include "burin/common/error.hpp"
#include "burin/common/statistics.hpp"
#include "burin/compositor/frame_notice.hpp"
#include "burin/compositor/in_process_executor.hpp"
#include "burin/compositor/pixel_algebra.hpp"
#include "burin/compositor/replay.hpp"
#include "burin/node/worker.hpp"

namespace burin::host::bench {

namespace {

using compositor::FrameTrace;
using compositor::LinkClass;
using compositor::Subimage;
using compositor::TraceStep;

/// The bricks of one process, drawn one at a time as if each were a rank's own.
class IsolatedRanks {
 public:
  IsolatedRanks(const Communicator& self, PreparedScene& prepared, int ranks)
      : camera_{resolveCamera(prepared.scene, prepared.facts)},
        worker_{self, prepared.scene, *prepared.source,
                workerOptions(prepared, {.bricks = ranks, .views = {camera_}})},
        room_(camera_.image.pixels()) {
    const std::size_t bricks = worker_.tree().brickCount();
    if (bricks != static_cast<std::size_t>(ranks))
      fail(ExitCode::kUsage, "--bricks {}: the volume makes {} bricks then", ranks, bricks);
  }

  int bricks() const { return static_cast<int>(worker_.tree().brickCount()); }
  const Camera& camera() const { return camera_; }
  std::vector<BrickId> visibilityOrder() const { return worker_.tree().visibilityOrder(camera_); }

  double drawMs(int brick) {
    double ms = 0;
    {
      const PhaseTimer timer{ms};
      draw(brick);
    }
    return ms;
  }
  Subimage<Rgba> subimage(int brick) {
    const auto drawn = draw(brick);
    return {drawn.frame, drawn.active, {drawn.pixels.begin(), drawn.pixels.end()}};
  }

 private:
  compositor::SubimageView<Rgba> draw(int brick) {
    RankStatistics unused;
    return worker_.drawBrick(BrickId{static_cast<std::uint32_t>(brick)}, camera_, unused,
                             [&](std::size_t pixels) { return std::span{room_}.first(pixels); });
  }

  Camera camera_;
  node::Worker worker_;
  std::vector<Rgba> room_;
};

/// Each brick's median.
std::vector<double> renderMs(IsolatedRanks& ranks, int repeats) {
  std::vector<std::vector<double>> times(static_cast<std::size_t>(ranks.bricks()));
  for (int round = -1; round < repeats; ++round) {  // the first one warms up
    for (int brick = 0; brick < ranks.bricks(); ++brick) {
      const double ms = ranks.drawMs(brick);
      if (round >= 0) times[static_cast<std::size_t>(brick)].push_back(ms);
    }
  }
  std::vector<double> medians;
  for (const std::vector<double>& ms : times) medians.push_back(median(ms));
  return medians;
}

/// What compositing would take on a cluster of machines like this one, joined by a fast link.
/// `images`: by rank; `order`: ranks front to back.
double compositeMs(const Communicator& self, std::span<const Rank> order,
                   const std::vector<Subimage<Rgba>>& images) {
  const auto ranks = static_cast<int>(images.size());
  compositor::CompositeOptions options;
  options.link = LinkClass::kFast;
  options.isSharingMemory = false;
  auto composited = compositor::compositeInProcess<compositor::Over>(options, images.front().frame,
                                                                     order, images);
  for (int rank = 0; rank < ranks; ++rank) {
    const auto i = static_cast<std::size_t>(rank);
    if (const Outcome& outcome = composited.outcomes[i]; outcome.failed)
      fail(outcome.code, "compositing in one process: {}", outcome.reason);
    FrameTrace& trace = composited.traces[i];
    trace.insert(trace.begin(),
                 TraceStep{.kind = TraceStep::Kind::kScan,
                           .pixels = static_cast<std::int64_t>(images[i].active.pixels())});
    trace = compositor::withCollectives(trace, rank, ranks, compositor::noticeBytes(ranks));
  }
  const auto& largest = *std::ranges::max_element(
      images, {}, [](const Subimage<Rgba>& image) { return image.pixels.size(); });
  compositor::ReplayMachine machine;
  machine.link = compositor::assumedMachine(LinkClass::kFast).link;
  machine.work = measureWorkRates(self, largest);
  return 1e3 * compositor::replay(composited.traces, machine);
}

}  // namespace

ScalingMeasurement measureIsolated(const Communicator& self, PreparedScene& prepared, int ranks,
                                   bool hasHost, int repeats) {
  IsolatedRanks isolated{self, prepared, ranks};
  const std::vector<double> ms = renderMs(isolated, repeats);

  const int first = hasHost ? 1 : 0;
  std::vector<Subimage<Rgba>> images(hasHost ? 1 : 0, {isolated.camera().image, {}, {}});
  for (int brick = 0; brick < isolated.bricks(); ++brick)
    images.push_back(isolated.subimage(brick));
  std::vector<Rank> order;
  for (const BrickId brick : isolated.visibilityOrder())
    order.push_back(Rank{static_cast<int>(brick) + first});

  ScalingMeasurement row;
  row.isIsolated = true;
  row.ranks = ranks;
  row.renderMaxMs = std::ranges::max(ms);
  row.renderMeanMs = std::reduce(ms.begin(), ms.end()) / static_cast<double>(ms.size());
  row.compositeMs = compositeMs(self, order, images);
  row.frameMs = row.renderMaxMs + row.compositeMs;
  row.frame = isolated.camera().image;
  row.dims = prepared.facts.grid.dims;
  row.repeats = repeats;
  return row;
}

}  // namespace burin::host::bench
