#include <algorithm>
#include <cstdio>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/bench_output.hpp"
#include "bench/first_ranks.hpp"
#include "bench/link_parameters.hpp"
#include "bench/memory_source.hpp"
#include "bench/output_folder.hpp"
#include "bench/scaling_measurement.hpp"
#include "bench/scaling_scenes.hpp"
#include "bench/scaling_table.hpp"
#include "bench/single_image_scene.hpp"
#include "burin/common/log.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/shared_error.hpp"

namespace burin::host {

namespace {

using namespace bench;

/// Lum and Ma's eight nodes; a ninth was the host.
constexpr int kLumMaRanks = 8;
/// Weak scaling ends before larger volumes: each voxel takes 4 bytes and some for the maps.
constexpr std::size_t kLargestWeakVoxels = std::size_t{1} << 28;

bool isBuiltIn(const BenchScalingOptions& options) {
  return options.input.empty() && options.volume.empty();
}

struct NamedInput {
  std::string name;
  PreparedScene prepared;
};

/// Collective.
NamedInput strongInput(const Communicator& comm, const BenchScalingOptions& options) {
  NamedInput input;
  if (isBuiltIn(options)) {
    input.name = "ct-phantom";
    together(comm, "making a volume", [&] { input.prepared = strongScene(options.side); });
  } else {
    RenderOptions what;
    what.input = options.input;
    what.volume = options.volume;
    input.name = tableName(options.input.empty() ? options.volume : options.input);
    input.prepared = prepareSingleImage(comm, what);
  }
  return input;
}

/// What rank 0 knows in the end.
class Results {
 public:
  void add(ScalingMeasurement row, const char* kind, const std::string& scene) {
    row.kind = kind;
    row.scene = scene;
    std::fputs(scalingLine(row).c_str(), stdout);
    std::fflush(stdout);
    rows_.push_back(std::move(row));
  }
  std::span<const ScalingMeasurement> rows() const { return rows_; }

 private:
  std::vector<ScalingMeasurement> rows_;
};

/// 1, 2, 4 … and all ranks, but no more than there are cores for.
std::vector<int> wallCounts(const Communicator& comm) {
  const int cores = sharedCores(comm);
  const int most = cores > 0 ? std::min(cores, comm.size()) : comm.size();
  std::vector<int> counts;
  for (int ranks = 1; ranks < most; ranks *= 2) counts.push_back(ranks);
  counts.push_back(most);
  return counts;
}

/// Collective. Whole frames on ever more ranks.
void measureWallTimes(const Communicator& comm, NamedInput& input, int repeats, Results& results) {
  for (const int ranks : wallCounts(comm)) {
    Outcome outcome;
    if (const auto part = firstRanks(comm, ranks)) {
      // What one rank alone throws ends the job, as the others of `part` wait for it.
      try {
        const auto row = measureWall(*part, input.prepared, repeats);
        if (comm.isRoot()) results.add(row, "strong", input.name);
      } catch (const CollectiveError& error) {
        outcome = {true, error.code(), error.what()};
      }
    }
    agree(comm, "measuring", outcome);  // where the others wait without using a core
  }
}

/// Local to rank 0.
void measureRanksAlone(const BenchScalingOptions& options, NamedInput& input, Results& results) {
  const Communicator self{MPI_COMM_SELF};
  if (isBuiltIn(options)) input.prepared.source = inMemory(*input.prepared.source);
  for (const int ranks : options.bricks)
    results.add(measureIsolated(self, input.prepared, ranks, false, options.repeats), "strong",
                input.name);
  input.prepared.source.reset();
  if (!isBuiltIn(options)) return;

  const int cells = options.side / 4;
  for (const int ranks : options.bricks) {
    const glm::ivec3 dims = weakDims(cells, ranks);
    if (IndexBox{glm::ivec3{0}, dims}.count() > kLargestWeakVoxels) {
      note("weak scaling ends before {} ranks: {} x {} x {} voxels", ranks, dims.x, dims.y, dims.z);
      break;
    }
    auto scene = weakScene(cells, ranks);
    results.add(measureIsolated(self, scene, ranks, false, options.repeats), "weak", "ct-phantom");
  }
  for (const int layers : {1, 2}) {
    auto scene = lumMaScene(2 * options.side, layers);
    results.add(measureIsolated(self, scene, kLumMaRanks, true, options.repeats), "lum-ma",
                layers == 1 ? "one-layer" : "two-layers");
  }
}

}  // namespace

int runCommand(const Communicator& comm, const BenchScalingOptions& options) {
  onRoot(comm, [&] { createOutputFolder(options.folder, "scaling.csv"); });
  auto input = strongInput(comm, options);
  Results results;
  measureWallTimes(comm, input, options.repeats, results);
  onRoot(comm, [&] { measureRanksAlone(options, input, results); });
  onRoot(comm, [&] {
    const auto& rows = results.rows();
    publish(options.folder, {"scaling", scalingTableCsv(rows), scalingTablePlots(rows),
                             scalingSummary(rows), rows.size()});
  });
  return static_cast<int>(ExitCode::kDone);
}

}  // namespace burin::host
