#include "bench/skip_measurement.hpp"

#include <algorithm>
#include <vector>

#include "bench/median.hpp"
#include "burin/host/histogram.hpp"

namespace burin::host::bench {

namespace {

/// By the histogram's bins: exact for integer voxels of up to kMostBins values.
double visibleFraction(const Communicator& comm, PreparedScene& prepared,
                       const node::VolumeSurvey& survey) {
  const Histogram histogram = computeHistogram(comm, *prepared.source, survey);
  const bool isWhole = prepared.source->info().type != node::VoxelType::kF32;
  const double width = isWhole ? histogram.binWidth - 1 : histogram.binWidth;
  std::int64_t visible = 0;
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
    const double lowest = histogram.edge(bin);
    const auto shows = [&](const Layer& layer) {
      const TransferFunction& function = layer.transferFunction;
      return function.largestExtinction(lowest, lowest + width,
                                        function.opacityUnitLength.value()) > 0;
    };
    if (std::ranges::any_of(prepared.scene.layers, shows)) visible += histogram.counts[bin];
  }
  const auto voxels = static_cast<double>(prepared.source->info().grid.voxelCount());
  return static_cast<double>(visible) / voxels;
}

/// Every transfer function begins a little later and is a little fainter: shows nothing that
/// `scene` does not, so nothing is loaded for it, by the same program.
Scene edited(Scene scene) {
  for (Layer& layer : scene.layers) {
    auto& points = layer.transferFunction.points;
    if (points.size() > 1) points[0].value += 0.1 * (points[1].value - points[0].value);
    for (TransferPoint& point : points) point.opacity *= 0.9;
  }
  return scene;
}

/// Collective. Beyond the frame's own time: each frame after an edit against the same scene's next.
double medianEditMs(TimedDrawing& drawing, const Scene& scene, int repeats) {
  const Scene other = edited(scene);
  std::vector<double> beyond;
  for (int round = -1; round < repeats; ++round) {  // the first one warms up
    for (const Scene* next : {&other, &scene}) {
      const double withEdit = drawing.editMs(*next);
      const double without = drawing.drawMs();
      if (round >= 0) beyond.push_back(withEdit - without);
    }
  }
  return median(beyond);
}

void setTimes(SkipMeasurement& row, const std::vector<double>& ms) {
  row.repeats = static_cast<int>(ms.size());
  row.medianMs = median(ms);
  row.smallestMs = std::ranges::min(ms);
  row.largestMs = std::ranges::max(ms);
}

SkipMeasurement countedRow(const Communicator& comm, const std::string& name,
                           PreparedScene& prepared, bool isSkipping) {
  TimedDrawing counting{
      comm, prepared, {.skip = isSkipping, .countSamples = true, .wholeBricks = !isSkipping}};
  const RankStatistics samples = counting.count();
  SkipMeasurement row;
  row.scene = name;
  row.visibleFraction = visibleFraction(comm, prepared, counting.worker().survey());
  row.isSkipping = isSkipping;
  row.samplesVisited = samples.samplesVisited;
  row.samplesShaded = samples.samplesShaded;
  row.samplesInOccupiedCells = samples.samplesInOccupiedCells;
  row.leaps = samples.leaps;
  return row;
}

}  // namespace

std::array<SkipMeasurement, 2> measureSkip(const Communicator& comm, const std::string& name,
                                           PreparedScene& prepared, TimedDrawing* dense,
                                           int repeats) {
  std::array rows{countedRow(comm, name, prepared, true), countedRow(comm, name, prepared, false)};
  TimedDrawing on{comm, prepared, {.skip = true}};
  TimedDrawing off{comm, prepared, {.skip = false, .wholeBricks = true}};
  std::vector<double> onMs, offMs, denseMs;
  for (int round = -1; round < repeats; ++round) {  // the first one warms up
    const double first = on.drawMs();
    const double second = off.drawMs();
    const double third = dense != nullptr ? dense->drawMs() : 0;
    if (round < 0) continue;
    onMs.push_back(first);
    offMs.push_back(second);
    denseMs.push_back(third);
  }
  setTimes(rows[0], onMs);
  rows[0].editMs = std::max(0.0, medianEditMs(on, prepared.scene, repeats));
  setTimes(rows[1], offMs);
  if (const double reference = median(denseMs); reference > 0) {
    for (SkipMeasurement& row : rows) row.ratioToDense = row.medianMs / reference;
  }
  return rows;
}

}  // namespace burin::host::bench
