#include "bench/accuracy_measurement.hpp"
#include "bench/accuracy_scenes.hpp"
#include "bench/accuracy_table.hpp"
#include "bench/bench_output.hpp"
#include "bench/output_folder.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/shared_error.hpp"

namespace burin::host {

int runCommand(const Communicator& comm, const BenchAccuracyOptions& options) {
  using namespace bench;
  onRoot(comm, [&] { createOutputFolder(options.folder, "accuracy.csv"); });
  AccuracyPlan plan;
  plan.repeats = options.repeats;
  if (options.quick) {
    plan.referenceError = 1e-4;
    plan.sliceSteps = {1};
    plan.historicSteps = {};
  }
  std::vector<AccuracyMeasurement> rows;
  for (NamedScene& scene : accuracyScenes(comm, options)) {
    scene.prepared.scene.imageSize = {options.side, options.side};
    const auto measured = measureAccuracy(comm, scene, plan);
    rows.insert(rows.end(), measured.begin(), measured.end());
  }
  onRoot(comm, [&] {
    publish(options.folder, {"accuracy", accuracyCsv(rows), accuracyPlots(rows),
                             accuracySummary(rows), rows.size()});
  });
  return static_cast<int>(ExitCode::kDone);
}

}  // namespace burin::host
