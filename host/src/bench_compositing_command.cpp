#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "bench/compositing_measurement.hpp"
#include "bench/compositing_plots.hpp"
#include "bench/compositing_table.hpp"
#include "bench/first_ranks.hpp"
#include "bench/frame_model.hpp"
#include "bench/gnuplot.hpp"
#include "bench/link_parameters.hpp"
#include "bench/output_folder.hpp"
#include "bench/scaling_model.hpp"
#include "burin/common/error.hpp"
#include "burin/common/log.hpp"
#include "burin/common/temporary_file.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/shared_error.hpp"

namespace burin::host {

namespace {

using namespace bench;

/// Shares of active pixels per rank, for the plot against them.
constexpr double kDiscFractions[] = {0.001, 0.004, 0.016, 0.063, 0.25, 0.5};
constexpr int kDiscSide = 1024;

/// Beyond this a contender's frame is wrong; float `over` of a few dozen ranks stays below 1e-5.
constexpr double kWrong = 1e-4;

/// "shm" if all ranks share memory. Collective.
std::string networkName(const Communicator& comm, const BenchCompositingOptions& options) {
  if (!options.network.empty()) return options.network;
  MPI_Comm host = MPI_COMM_NULL;
  checkMpi(MPI_Comm_split_type(comm.get(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host),
           "MPI_Comm_split_type");
  int onHost = 0;
  checkMpi(MPI_Comm_size(host, &onHost), "MPI_Comm_size");
  checkMpi(MPI_Comm_free(&host), "MPI_Comm_free");
  std::int64_t fewest = onHost;
  allReduce(comm, std::span{&fewest, 1}, MPI_MIN);
  return fewest == comm.size() ? "shm" : "network";
}

/// Measures everything on one communicator. Collective over it.
class Bench {
 public:
  Bench(const Communicator& comm, const BenchCompositingOptions& options)
      : comm_{comm},
        options_{options},
        link_{measureLinkParameters(comm)},
        cores_{sharedCores(comm)} {
    peers_.push_back(burinContenders(comm));
    std::string whyNot;
    peers_.push_back(icetContenders(comm, whyNot));
    const bool isFirst = comm.size() == options.ranks.front();  // one warning is enough
    if (peers_.back().empty() && comm.isRoot() && isFirst)
      warn("measuring without a peer: {}", whyNot);
  }

  void measureScenes(std::span<NamedScene> scenes) {
    for (NamedScene& scene : scenes) {
      SceneInput input{comm_, scene, options_.dedicatedHost};
      for (const int side : options_.sides) measure(input.make({side, side}));
    }
  }
  void measureDense() {
    for (const int side : options_.sides)
      measure(denseInput(comm_, {side, side}, options_.dedicatedHost));
  }
  void measureDiscs() {
    for (const double fraction : kDiscFractions)
      measure(discInput(comm_, {kDiscSide, kDiscSide}, fraction, options_.dedicatedHost));
  }

  const std::vector<CompositingMeasurement>& rows() const { return rows_; }
  const std::vector<FrameModel>& models() const { return models_; }

 private:
  void measure(const CompositingInput& input) {
    const FrameModel model = makeFrameModel(comm_, input, link_, cores_);
    const auto rows = measureCompositing(comm_, peers_, input, model, options_.repeats);
    models_.push_back(model);
    if (comm_.isRoot()) {
      std::fputs(caseLine(rows).c_str(), stdout);
      std::fflush(stdout);
    }
    for (const CompositingMeasurement& row : rows) {
      if (row.largestError > kWrong)
        warn("{} {}: the frame of {} on {} ranks is off by {:.3g}", row.peer, row.schedule,
             row.input, row.ranks, row.largestError);
    }
    rows_.insert(rows_.end(), rows.begin(), rows.end());
  }

  const Communicator& comm_;
  const BenchCompositingOptions& options_;
  compositor::LogGP link_;
  int cores_;
  std::vector<Contenders> peers_;
  std::vector<CompositingMeasurement> rows_;
  std::vector<FrameModel> models_;
};

struct Results {
  std::vector<CompositingMeasurement> rows;
  std::vector<FrameModel> models;
};

void write(const BenchCompositingOptions& options, const Results& results,
           const std::string& network) {
  const std::filesystem::path& folder = options.folder;
  const std::span<const CompositingMeasurement> rows = results.rows;
  writeTextFile(folder / "model.csv", modelCsv(results.models));
  writeTextFile(folder / "model_scaling.csv", scalingCsv(results.models.front()));
  writeTextFile(folder / "model_scaling.gp", scalingPlot());
  writeTextFile(folder / "compositing.csv", compositingCsv(rows, network));
  writeTextFile(folder / "compositing.gp", compositingPlots(rows));
  std::fputs(compositingSummary(rows).c_str(), stdout);
  if (!runGnuplot(folder, "compositing.gp") || !runGnuplot(folder, "model_scaling.gp"))
    warn("gnuplot is not installed (scripts/setup bench), so there are no plots");
  note("{}: {} measurements", (folder / "compositing.csv").string(), rows.size());
}

/// Collective over `part`. What all its ranks throw alike becomes an outcome, for the ranks outside
/// to learn of; what one rank throws alone ends the job, as the others of `part` wait for it.
Outcome measureOn(const Communicator& part, const BenchCompositingOptions& options,
                  std::span<NamedScene> scenes, Results& results) {
  try {
    Bench bench{part, options};
    bench.measureScenes(scenes);
    bench.measureDense();
    const bool isLast = part.size() == options.ranks.back();
    if (isLast && !options.quick) bench.measureDiscs();
    results.rows.insert(results.rows.end(), bench.rows().begin(), bench.rows().end());
    results.models.insert(results.models.end(), bench.models().begin(), bench.models().end());
  } catch (const CollectiveError& error) {
    return {true, error.code(), error.what()};
  }
  return {};
}

}  // namespace

int runCommand(const Communicator& comm, const BenchCompositingOptions& options) {
  onRoot(comm, [&] { createOutputFolder(options.folder, "compositing.csv"); });
  RenderOptions what;
  what.input = options.input;
  what.volume = options.volume;
  auto scenes = benchScenes(comm, what);
  const std::string network = networkName(comm, options);
  Results results;
  for (const int ranks : options.ranks) {
    Outcome outcome;
    if (const auto part = firstRanks(comm, ranks))
      outcome = measureOn(*part, options, scenes, results);
    // Where the ranks that take no part wait without using a core.
    agree(comm, "measuring", outcome);
  }
  onRoot(comm, [&] { write(options, results, network); });
  return static_cast<int>(ExitCode::kDone);
}

}  // namespace burin::host
