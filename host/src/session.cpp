#include "burin/host/session.hpp"

#include <algorithm>

#include "burin/common/error.hpp"
#include "burin/common/log.hpp"
#include "burin/common/temporary_file.hpp"
#include "burin/host/interrupt.hpp"
#include "burin/host/shared_error.hpp"
#include "burin/host/trace_file.hpp"
#include "picture_need.hpp"

namespace burin::host {

namespace {

/// What every rank learns of every other's part in a frame.
struct FrameReport {
  RankStatistics statistics;
  std::int64_t signal = 0;
};

}  // namespace

Session::Session(const Communicator& comm, const RenderOptions& options)
    : comm_{comm}, options_{options}, progress_{comm.isRoot() && !options.quiet} {
  if (!options_.trace.empty()) trace_.emplace();
  const TraceSpan setUp{"set up"};
  onRoot(comm_, [&] { deferInterrupts([&] { checkOutputs(options_); }); });
  progress_.show("reading the volume");
  prepared_ = prepareScene(comm_, options_);
  onRoot(comm_, [&] {
    checkConflicts(options_, prepared_.scene.volume.file, prepared_.scene.labels.file);
  });
  together(comm_, "the scene", [&] { checkTechnique(); });
  checkCameras();
  checkMemory(comm_, pictureNeed(comm_, prepared_.scene.imageSize));
  if (!options_.saveScene.empty()) {
    onRoot(comm_, [&] {
      const std::string text = sceneTextFor(prepared_.scene, options_.saveScene);
      deferInterrupts([&] { writeTextFile(options_.saveScene, text); });
    });
  }
  onRoot(comm_, [&] {
    loadPictureEncoder();
    display_.emplace(prepared_, options_);
  });
  progress_.show("loading bricks");
  frames_ = makeFrameMaker();
  statistics_.ranks = comm_.size();
  statistics_.samplesCounted = options_.worker.countSamples && !options_.reference;
}

void Session::checkTechnique() const {
  const Quality& quality = prepared_.scene.quality;
  if (!options_.reference)
    return node::checkTechnique(prepared_.scene, options_.worker.technique,
                                options_.worker.precision);
  if (quality.combine != Combine::kSum)
    fail(ExitCode::kUsage, "--reference adds layers up: expected quality.combine \"sum\"");
  if (quality.normals != Normals::kExact || quality.palettes != Palettes::kAfter)
    fail(ExitCode::kUsage,
         "--reference is exact: expected quality.normals \"exact\" and quality.palettes "
         "\"after\"");
}

double Session::orbitDeg(int index) const {
  return options_.frames == 0 ? 0 : options_.orbitDeg * index / options_.frames;
}

/// A camera that cannot be is found before anything is drawn.
void Session::checkCameras() const {
  together(comm_, "the camera", [&] {
    for (int i = 0; i < std::max(1, options_.frames); ++i)
      resolveCamera(prepared_.scene, prepared_.facts, orbitDeg(i));
  });
}

/// Some of the frames' cameras, all along an orbit.
std::vector<Camera> Session::someViews() const {
  constexpr int kMost = 8;
  const int frames = std::max(1, options_.frames);
  const int count = std::min(frames, kMost);
  std::vector<Camera> views;
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<int>(std::int64_t{frames} * i / count);
    views.push_back(resolveCamera(prepared_.scene, prepared_.facts, orbitDeg(index)));
  }
  return views;
}

std::unique_ptr<FrameMaker> Session::makeFrameMaker() {
  if (!options_.reference) {
    node::WorkerOptions worker = options_.worker;
    worker.views = someViews();
    return makeRaycastFrames(comm_, prepared_, worker, options_.merge);
  }
  return makeReferenceFrames(comm_, prepared_, options_.worker, [this](double share) {
    progress_.show(fmt::format("reference {:.0f} %", 100 * share));
  });
}

int Session::run() {
  const InterruptWatch watch;
  const int count = std::max(1, options_.frames);
  for (int i = 0; i < count; ++i) {
    progress_.show(count > 1 ? fmt::format("frame {} of {}", i + 1, count) : "drawing");
    if (const int signal = runFrame(i); signal != 0) {
      progress_.clear();
      if (comm_.isRoot()) note("stopped by signal {}, frame {} dropped", signal, i);
      return kSignalExitBase + signal;
    }
  }
  progress_.clear();
  if (!options_.stats.empty())
    onRoot(comm_, [&] { writeTextFile(options_.stats, statisticsJson(statistics_)); });
  if (trace_) writeTrace(comm_, *trace_, options_.trace);
  if (comm_.isRoot()) reportResult();
  return static_cast<int>(ExitCode::kDone);
}

int Session::runFrame(int index) {
  FrameStatistics frame;
  FrameReport mine{};
  const Outcome finishing = draw(index, frame, mine.statistics);
  mine.signal = interruptSignal();
  std::int64_t signal = 0;
  for (const FrameReport& report : allGather(comm_, mine)) {
    frame.ranks.push_back(report.statistics);
    signal = std::max(signal, report.signal);
  }
  if (signal != 0) return static_cast<int>(signal);
  agreeWithRoot(comm_, finishing);
  writeFrame(index, frame);
  return 0;
}

/// Scene, size and options stay through a session, so only the view can be another one.
bool Session::isThere(double orbit) const {
  return options_.worker.skip && !options_.redraw && drawnDeg_ == orbit;
}

/// From the camera to the finished picture in rank 0's memory: the part that `frame_ms` times.
/// Returns what became of the finish passes, which are rank 0's alone.
Outcome Session::draw(int index, FrameStatistics& frame, RankStatistics& mine) {
  mine.rank = static_cast<std::int32_t>(comm_.rank());
  Outcome finishing;
  const double orbit = orbitDeg(index);
  frame.isUnchanged = isThere(orbit);
  if (frame.isUnchanged) {
    mine.bricks = drawn_.bricks;
    mine.residentVoxelBytes = drawn_.residentVoxelBytes;
  } else {
    const PhaseTimer whole{frame.frameMs, "frame"};
    Camera camera;
    {
      const PhaseTimer timer{mine.phases, Phase::kUpdate};
      camera = resolveCamera(prepared_.scene, prepared_.facts, orbit);
    }
    const ImageView<const Rgba> image = frames_->make(camera, mine);
    frame.composite = frames_->lastComposite();
    if (display_) {
      const PhaseTimer timer{mine.phases, Phase::kFinish};
      finishing = attempt([&] { display_->finish(image, camera); });
    }
    drawnDeg_ = orbit;
    drawn_ = mine;
  }
  mine.peakRssBytes = peakResidentBytes();
  return finishing;
}

void Session::writeFrame(int index, FrameStatistics& frame) {
  RankStatistics& root = frame.ranks.front();
  onRoot(comm_, [&] {
    const PhaseTimer timer{root.phases, Phase::kWrite};
    display_->write(index, orbitDeg(index));
  });
  frame.phases = root.phases;
  statistics_.frames.push_back(frame);
}

void Session::reportResult() const {
  const auto& frames = statistics_.frames;
  double total = 0;
  int drawn = 0;
  for (const FrameStatistics& frame : frames) {
    total += frame.frameMs;
    drawn += frame.isUnchanged ? 0 : 1;
  }
  const auto last = static_cast<int>(frames.size()) - 1;
  const std::string name = frameFile(options_, 0).string();
  const std::string upTo =
      last > 0 ? " … " + frameFile(options_, last).filename().string() : std::string{};
  const ImageSize size = prepared_.scene.imageSize;
  note("{}{}: {} x {}, {:.1f} ms per frame on {} rank{}", name, upTo, size.width, size.height,
       total / drawn, comm_.size(), comm_.size() == 1 ? "" : "s");
}

}  // namespace burin::host
