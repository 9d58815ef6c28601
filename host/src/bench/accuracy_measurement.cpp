#include "bench/accuracy_measurement.hpp"

#include <algorithm>
#include <chrono>
#include <memory>

#include "bench/converged_picture.hpp"
#include "bench/median.hpp"
#include "burin/host/frame_maker.hpp"

namespace burin::host::bench {

namespace {

/// Whether "over" differs from "sum": if anything meets at a sample.
bool hasSeveralPasses(const Scene& scene) {
  return scene.layers.size() > 1 || scene.layers.front().hasLines();
}

std::vector<AccuracyMeasurement> raysOf(const std::string& scene, const AccuracyPlan& plan) {
  std::vector<AccuracyMeasurement> ways;
  const auto add = [&](bool preintegrated, std::optional<double> step,
                       std::optional<double> maxError) {
    AccuracyMeasurement& way = ways.emplace_back();
    way.scene = scene;
    way.preintegrated = preintegrated;
    way.stepVoxels = step;
    way.maxErrorAsked = maxError;
  };
  for (const bool preintegrated : {true, false}) {
    for (const double step : plan.steps) add(preintegrated, step, {});
    for (const double error : plan.maxErrors) add(preintegrated, {}, error);
  }
  return ways;
}

std::vector<AccuracyMeasurement> slicesOf(const std::string& scene, bool severalPasses,
                                          const AccuracyPlan& plan) {
  std::vector<AccuracyMeasurement> ways;
  for (const Combine combine : {Combine::kSum, Combine::kOver}) {
    if (combine == Combine::kOver && !severalPasses) continue;
    for (const auto precision :
         {node::Precision::kFloat, node::Precision::kHalf, node::Precision::kByte})
      for (const double step : plan.sliceSteps) {
        AccuracyMeasurement& way = ways.emplace_back();
        way.scene = scene;
        way.technique = node::Technique::kSlices;
        way.precision = precision;
        way.combine = combine;
        way.stepVoxels = step;
      }
  }
  return ways;
}

/// What Lum and Ma's hardware did, each by itself on top of float slices without pre-integration,
/// then all of it.
std::vector<AccuracyMeasurement> historicOf(const Scene& scene, const std::string& name,
                                            const AccuracyPlan& plan) {
  std::vector<AccuracyMeasurement> ways;
  const auto add = [&](Normals normals, Palettes palettes, bool isHardware) {
    for (const double step : plan.historicSteps) {
      AccuracyMeasurement& way = ways.emplace_back();
      way.scene = name;
      way.technique = node::Technique::kSlices;
      way.preintegrated = false;
      way.normals = normals;
      way.palettes = palettes;
      way.stepVoxels = step;
      if (!isHardware) continue;
      way.precision = node::Precision::kByte;
      way.combine = Combine::kOver;
    }
  };
  add(Normals::kExact, Palettes::kAfter, false);
  if (gradientNeeded(scene)) add(Normals::kQuantised, Palettes::kAfter, false);
  add(Normals::kExact, Palettes::kBefore, false);
  add(Normals::kQuantised, Palettes::kBefore, true);
  return ways;
}

/// The plan's ways of drawing, not yet measured.
std::vector<AccuracyMeasurement> waysOf(const NamedScene& scene, const AccuracyPlan& plan) {
  std::vector<AccuracyMeasurement> ways = raysOf(scene.name, plan);
  const auto slices = slicesOf(scene.name, hasSeveralPasses(scene.prepared.scene), plan);
  ways.insert(ways.end(), slices.begin(), slices.end());
  const auto historic = historicOf(scene.prepared.scene, scene.name, plan);
  ways.insert(ways.end(), historic.begin(), historic.end());
  return ways;
}

Quality qualityOf(const AccuracyMeasurement& way) {
  Quality quality;
  quality.preintegrated = way.preintegrated;
  quality.maxError = way.maxErrorAsked;
  // Steps are compared by themselves: rays end only where nothing could be seen any more.
  if (way.stepVoxels) quality = {*way.stepVoxels, 1e-4, way.preintegrated, {}};
  quality.combine = way.combine;
  quality.normals = way.normals;
  quality.palettes = way.palettes;
  return quality;
}

/// Collective.
std::unique_ptr<FrameMaker> makerOf(const Communicator& comm, PreparedScene& prepared,
                                    const AccuracyMeasurement& way, bool countSamples) {
  prepared.scene.quality = qualityOf(way);
  return makeRaycastFrames(
      comm, prepared,
      {.countSamples = countSamples, .technique = way.technique, .precision = way.precision}, {});
}

}  // namespace

std::vector<AccuracyMeasurement> measureAccuracy(const Communicator& comm, NamedScene& scene,
                                                 const AccuracyPlan& plan) {
  const Camera camera = resolveCamera(scene.prepared.scene, scene.prepared.facts);
  const Image<Rgba> coarse =
      convergedPicture(comm, scene.prepared, 2 * plan.referenceError, camera);
  const Image<Rgba> truth = convergedPicture(comm, scene.prepared, plan.referenceError, camera);
  std::vector<AccuracyMeasurement> rows = waysOf(scene, plan);
  std::vector<std::unique_ptr<FrameMaker>> makers;
  for (const AccuracyMeasurement& way : rows)
    makers.push_back(makerOf(comm, scene.prepared, way, false));
  std::vector<std::vector<double>> times(rows.size());
  for (int i = 0; i <= plan.repeats; ++i)
    for (std::size_t k = 0; k < rows.size(); ++k) {
      RankStatistics unused;
      const auto start = std::chrono::steady_clock::now();
      const ImageView<const Rgba> frame = makers[k]->make(camera, unused);
      const std::chrono::duration<double, std::milli> time =
          std::chrono::steady_clock::now() - start;
      if (i > 0) times[k].push_back(time.count());  // the first compiles and warms up
      if (i == 0 && comm.isRoot()) rows[k].error = pictureError(frame, truth);
    }
  makers.clear();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].medianMs = median(times[k]);
    RankStatistics counted;
    makerOf(comm, scene.prepared, rows[k], true)->make(camera, counted);
    std::int64_t samples = counted.samplesVisited;
    allReduce(comm, std::span{&samples, 1}, MPI_SUM);
    rows[k].samplesVisited = samples;
    if (comm.isRoot()) rows[k].referenceChange = pictureError(coarse, truth).largest;
  }
  return rows;
}

}  // namespace burin::host::bench
