#include <cstdio>

#include "bench/max_error_measurement.hpp"
#include "bench/max_error_table.hpp"
#include "bench/output_folder.hpp"
#include "burin/common/log.hpp"
#include "burin/common/temporary_file.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/progress.hpp"
#include "burin/host/shared_error.hpp"
#include "burin/node/procedural.hpp"

namespace burin::host {

namespace {

using namespace bench;

constexpr int kProceduralSide = 48;  // voxels

struct Wanted {
  std::string name;
  VolumeChoice choice;
};

/// The files, or all procedural kinds but the one without any detail and segmentations.
std::vector<Wanted> volumesOf(const BenchMaxErrorOptions& options) {
  std::vector<Wanted> volumes;
  for (const std::string& file : options.volumes) {
    Wanted& wanted = volumes.emplace_back();
    wanted.name = tableName(file);
    wanted.choice.file = file;
  }
  if (!volumes.empty()) return volumes;
  for (const node::ProceduralKind& kind : node::proceduralKinds()) {
    if (kind.name == "homogeneous" || kind.isLabels) continue;
    Wanted& wanted = volumes.emplace_back();
    wanted.name = kind.name;
    wanted.choice.procedural = kind.name;
    wanted.choice.dims = glm::ivec3{kProceduralSide};
  }
  return volumes;
}

NamedScene opened(const Communicator& comm, const Wanted& wanted) {
  NamedScene named{wanted.name, {}};
  named.prepared.source = openTogether(comm, wanted.choice);
  const node::VolumeInfo& info = named.prepared.source->info();
  named.prepared.facts = {info.grid, info.anatomical};
  named.prepared.scene.volume = wanted.choice;
  return named;
}

}  // namespace

int runCommand(const Communicator& comm, const BenchMaxErrorOptions& options) {
  onRoot(comm, [&] { createOutputFolder(options.folder, "max_error.csv"); });
  MaxErrorPlan plan;
  plan.side = options.side;
  plan.smallestStep = options.smallestStep;
  if (options.quick) plan.views.resize(1);
  const std::vector<Wanted> volumes = volumesOf(options);
  Progress progress{comm.isRoot()};
  std::vector<MaxErrorMeasurement> rows;
  for (const Wanted& wanted : volumes) {
    progress.show(wanted.name);
    NamedScene named = opened(comm, wanted);
    const auto measured = measureMaxError(comm, named, plan);
    rows.insert(rows.end(), measured.begin(), measured.end());
    // After each volume: all of them take hours.
    onRoot(comm, [&] { writeTextFile(options.folder / "max_error.csv", maxErrorCsv(rows)); });
  }
  progress.clear();
  onRoot(comm, [&] {
    std::fputs(maxErrorSummary(rows).c_str(), stdout);
    note("{}: {} pictures", (options.folder / "max_error.csv").string(), rows.size());
  });
  return static_cast<int>(ExitCode::kDone);
}

}  // namespace burin::host
