#include <cstdio>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/bench_output.hpp"
#include "bench/output_folder.hpp"
#include "bench/single_image_scene.hpp"
#include "bench/skip_measurement.hpp"
#include "bench/skip_scenes.hpp"
#include "bench/skip_table.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/shared_error.hpp"

namespace burin::host {

namespace {

using namespace bench;

constexpr double kFractions[] = {0.001, 0.01, 0.05, 0.25};
constexpr double kQuickFractions[] = {0.01, 0.25};

class SkipBench {
 public:
  SkipBench(const Communicator& comm, const BenchSkipOptions& options)
      : comm_{comm}, options_{options} {}

  void measureBuiltIn() {
    PreparedScene denseScene = make([&] { return ballScene(1, 1, options_.side); });
    TimedDrawing dense{comm_, denseScene, {}};
    const std::span<const double> fractions =
        options_.quick ? std::span<const double>{kQuickFractions} : kFractions;
    for (const auto& [name, count] : {std::pair{kBall, 1}, std::pair{kBalls, kManyBalls}}) {
      for (const double fraction : fractions) {
        auto balls = make([&] { return ballScene(count, fraction, options_.side); });
        measure(name, balls, &dense);
      }
    }
    auto vessels = make([&] { return vesselScene(options_.side); });
    measure("vessels", vessels, &dense);
    measure(kDense, denseScene, &dense);
  }

  void measureInput() {
    RenderOptions what;
    what.input = options_.input;
    what.volume = options_.volume;
    auto prepared = prepareSingleImage(comm_, what);
    measure(tableName(options_.input.empty() ? options_.volume : options_.input), prepared,
            nullptr);
  }

  const std::vector<SkipMeasurement>& rows() const { return rows_; }

 private:
  /// Collective. A volume may be too large for a rank's memory.
  template <typename Make>
  PreparedScene make(Make&& makeScene) {
    PreparedScene prepared;
    together(comm_, "making a volume", [&] { prepared = makeScene(); });
    return prepared;
  }

  void measure(const std::string& name, PreparedScene& prepared, TimedDrawing* dense) {
    const auto rows = measureSkip(comm_, name, prepared, dense, options_.repeats);
    rows_.insert(rows_.end(), rows.begin(), rows.end());
    if (!comm_.isRoot()) return;
    std::fputs(skipLine(rows[0], rows[1]).c_str(), stdout);
    std::fflush(stdout);
  }

  const Communicator& comm_;
  const BenchSkipOptions& options_;
  std::vector<SkipMeasurement> rows_;
};

}  // namespace

int runCommand(const Communicator& comm, const BenchSkipOptions& options) {
  onRoot(comm, [&] { createOutputFolder(options.folder, "skip.csv"); });
  SkipBench bench{comm, options};
  if (options.input.empty() && options.volume.empty()) {
    bench.measureBuiltIn();
  } else {
    bench.measureInput();
  }
  onRoot(comm, [&] {
    const auto& rows = bench.rows();
    publish(options.folder,
            {"skip", skipCsv(rows), skipPlots(rows), skipTargets(rows), rows.size()});
  });
  return static_cast<int>(ExitCode::kDone);
}

}  // namespace burin::host
