#include <cstdio>

#include "bench/accuracy_measurement.hpp"
#include "bench/accuracy_scenes.hpp"
#include "bench/accuracy_table.hpp"
#include "bench/gnuplot.hpp"
#include "bench/output_folder.hpp"
#include "burin/common/log.hpp"
#include "burin/common/temporary_file.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/shared_error.hpp"

namespace burin::host {

namespace {

using namespace bench;

void write(const BenchAccuracyOptions& options, std::span<const AccuracyMeasurement> rows) {
  writeTextFile(options.folder / "accuracy.csv", accuracyCsv(rows));
  writeTextFile(options.folder / "accuracy.gp", accuracyPlots(rows));
  std::fputs(accuracySummary(rows).c_str(), stdout);
  if (!runGnuplot(options.folder, "accuracy.gp"))
    warn("gnuplot is not installed (scripts/setup bench), so there are no plots");
  note("{}: {} measurements", (options.folder / "accuracy.csv").string(), rows.size());
}

}  // namespace

int runCommand(const Communicator& comm, const BenchAccuracyOptions& options) {
  onRoot(comm, [&] { createOutputFolder(options.folder, "accuracy.csv"); });
  AccuracyPlan plan;
  plan.repeats = options.repeats;
  if (options.quick) {
    plan.referenceStep = 1.0 / 16;
    plan.sliceSteps = {1};
  }
  std::vector<AccuracyMeasurement> rows;
  for (NamedScene& scene : accuracyScenes(comm, options)) {
    scene.prepared.scene.imageSize = {options.side, options.side};
    const auto measured = measureAccuracy(comm, scene, plan);
    rows.insert(rows.end(), measured.begin(), measured.end());
  }
  onRoot(comm, [&] { write(options, rows); });
  return static_cast<int>(ExitCode::kDone);
}

}  // namespace burin::host
