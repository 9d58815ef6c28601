#include <array>
#include <span>
#include <vector>

#include "bench/median.hpp"
#include "bench/scaling_measurement.hpp"
#include "burin/common/statistics.hpp"
#include "burin/host/frame_maker.hpp"

namespace burin::host::bench {

ScalingMeasurement measureWall(const Communicator& comm, PreparedScene& prepared, int repeats) {
  const Camera camera = resolveCamera(prepared.scene, prepared.facts);
  const auto frames = makeRaycastFrames(comm, prepared, {.views = {camera}}, {});
  std::vector<double> slowest, mean, rest, whole;
  for (int round = -1; round < repeats; ++round) {  // the first one warms up
    RankStatistics statistics;
    double frameMs = 0;
    // MPI's own barrier: waiting idly would let the ranks off up to 2 ms apart.
    checkMpi(MPI_Barrier(comm.get()), "MPI_Barrier");
    {
      const PhaseTimer timer{frameMs};
      frames->make(camera, statistics);
    }
    const double drawMs = statistics.phases[Phase::kDraw];
    std::array largest{drawMs, frameMs};  // a rank may leave the barrier later than another
    std::array sum{drawMs};
    allReduce(comm, largest, MPI_MAX);
    allReduce(comm, sum, MPI_SUM);
    if (round < 0) continue;
    slowest.push_back(largest[0]);
    mean.push_back(sum[0] / comm.size());
    rest.push_back(largest[1] - largest[0]);
    whole.push_back(largest[1]);
  }
  ScalingMeasurement row;
  row.isIsolated = false;
  row.ranks = comm.size();
  row.renderMaxMs = median(slowest);
  row.renderMeanMs = median(mean);
  row.compositeMs = median(rest);
  row.frameMs = median(whole);
  row.frame = camera.image;
  row.dims = prepared.facts.grid.dims;
  row.repeats = repeats;
  return row;
}

}  // namespace burin::host::bench
