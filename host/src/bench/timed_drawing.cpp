#include "bench/timed_drawing.hpp"

#include <array>
#include <span>

namespace burin::host::bench {

TimedDrawing::TimedDrawing(const Communicator& comm, PreparedScene& prepared, const Scene& scene,
                           const node::WorkerOptions& options)
    : comm_{comm},
      camera_{resolveCamera(scene, prepared.facts)},
      worker_{comm, scene, *prepared.source, workerOptions(prepared, options)},
      room_(camera_.image.pixels()) {}

double TimedDrawing::drawOnce(RankStatistics& statistics, const Scene* changed) {
  double ms = 0;
  // MPI's own barrier: waiting idly would let the ranks off up to 2 ms apart.
  checkMpi(MPI_Barrier(comm_.get()), "MPI_Barrier");
  if (changed != nullptr) {
    const PhaseTimer timer{ms};
    worker_.update(*changed);
  }
  collectively(comm_, "drawing", [&] {
    const PhaseTimer timer{ms};
    worker_.draw(camera_, statistics,
                 [&](std::size_t pixels) { return std::span{room_}.first(pixels); });
  });
  allReduce(comm_, std::span{&ms, 1}, MPI_MAX);
  return ms;
}

double TimedDrawing::drawMs() {
  RankStatistics unused;
  return drawOnce(unused);
}

double TimedDrawing::editMs(const Scene& scene) {
  RankStatistics unused;
  return drawOnce(unused, &scene);
}

RankStatistics TimedDrawing::count() {
  RankStatistics all;
  drawOnce(all);
  std::array<std::int64_t, 4> sums{all.samplesVisited, all.samplesShaded,
                                   all.samplesInOccupiedCells, all.leaps};
  allReduce(comm_, sums, MPI_SUM);
  all.samplesVisited = sums[0];
  all.samplesShaded = sums[1];
  all.samplesInOccupiedCells = sums[2];
  all.leaps = sums[3];
  return all;
}

}  // namespace burin::host::bench
