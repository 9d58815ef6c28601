#include "bench/rate_measurement.hpp"

#include <algorithm>
#include <vector>

#include "bench/median.hpp"

namespace burin::host::bench {

namespace {

FrameRate counted(const Communicator& comm, PreparedScene& prepared, const Scene& scene,
                  bool isSkipping) {
  TimedDrawing counting{comm, prepared, scene, {.skip = isSkipping, .countSamples = true}};
  const RankStatistics samples = counting.count();
  FrameRate rate;
  rate.samplesVisited = samples.samplesVisited;
  rate.samplesShaded = samples.samplesShaded;
  rate.samplesInOccupiedCells = samples.samplesInOccupiedCells;
  rate.leaps = samples.leaps;
  rate.pixels = static_cast<std::int64_t>(counting.camera().image.pixels());
  return rate;
}

void setTimes(FrameRate& rate, const std::vector<double>& ms) {
  rate.medianMs = median(ms);
  rate.smallestMs = std::ranges::min(ms);
  rate.largestMs = std::ranges::max(ms);
}

}  // namespace

RateMeasurement measureRate(const Communicator& comm, const std::string& name,
                            PreparedScene& prepared, Look look, Shading shading, int repeats) {
  const Scene scene = drawnAs(prepared.scene, look, shading);
  const Scene busyScene = withAllLanesBusy(scene, prepared.facts);
  RateMeasurement row{name,
                      look,
                      shading,
                      repeats,
                      counted(comm, prepared, scene, true),
                      counted(comm, prepared, busyScene, false)};
  TimedDrawing frame{comm, prepared, scene, {.skip = true}};
  TimedDrawing busy{comm, prepared, busyScene, {.skip = false}};
  std::vector<double> frameMs, busyMs, ratios;
  const auto samples = [](const FrameRate& rate) {
    return static_cast<double>(rate.samplesVisited);
  };
  for (int round = -1; round < repeats; ++round) {  // the first one warms up
    const double first = frame.drawMs();
    const double second = busy.drawMs();
    if (round < 0) continue;
    frameMs.push_back(first);
    busyMs.push_back(second);
    ratios.push_back(samples(row.frame) / first * second / samples(row.busy));
  }
  setTimes(row.frame, frameMs);
  setTimes(row.busy, busyMs);
  row.ratio = median(ratios);
  return row;
}

}  // namespace burin::host::bench
