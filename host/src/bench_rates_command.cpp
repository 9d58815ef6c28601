#include <cstdio>
#include <utility>
#include <vector>

#include "bench/bench_output.hpp"
#include "bench/compositing_input.hpp"
#include "bench/memory_source.hpp"
#include "bench/output_folder.hpp"
#include "bench/rate_measurement.hpp"
#include "bench/rate_table.hpp"
#include "bench/scaling_scenes.hpp"
#include "bench/single_image_scene.hpp"
#include "burin/common/error.hpp"
#include "burin/host/commands.hpp"
#include "burin/host/shared_error.hpp"

namespace burin::host {

namespace {

using namespace bench;

constexpr int kHeadSide = 256;
constexpr int kQuickHeadSide = 64;

/// Local. The procedural head, evaluated once.
NamedScene head(int side) {
  NamedScene named{"ct-phantom", strongScene(side)};
  named.prepared.source = inMemory(*named.prepared.source);
  return named;
}

/// Collective. A scene of INPUT.
NamedScene opened(const Communicator& comm, const std::string& input) {
  RenderOptions what;
  what.input = input;
  NamedScene named{tableName(input), prepareSingleImage(comm, what)};
  together(comm, "the scene", [&] {
    if (named.prepared.scene.quality.maxError)
      fail(ExitCode::kUsage,
           "{}: bench rates is about samples of a fixed step, not about quality.max_error", input);
  });
  return named;
}

void measure(const Communicator& comm, NamedScene named, const BenchRatesOptions& options,
             std::vector<RateMeasurement>& rows) {
  named.prepared.scene.imageSize = {options.side, options.side};
  for (const Look look : {Look::kOpaque, Look::kTranslucent}) {
    for (const Shading shading : {Shading::kPlain, Shading::kToneEdges}) {
      rows.push_back(measureRate(comm, named.name, named.prepared, look, shading, options.repeats));
      if (!comm.isRoot()) continue;
      std::fputs(rateLine(rows.back()).c_str(), stdout);
      std::fflush(stdout);
    }
  }
}

}  // namespace

int runCommand(const Communicator& comm, const BenchRatesOptions& options) {
  onRoot(comm, [&] { createOutputFolder(options.folder, "rates.csv"); });
  std::vector<RateMeasurement> rows;
  if (options.inputs.empty()) {
    NamedScene named;
    together(comm, "making a volume",
             [&] { named = head(options.quick ? kQuickHeadSide : kHeadSide); });
    measure(comm, std::move(named), options, rows);
  }
  for (const std::string& input : options.inputs) measure(comm, opened(comm, input), options, rows);
  onRoot(comm, [&] {
    publish(options.folder,
            {"rates", rateCsv(rows), ratePlots(rows), rateTargets(rows), rows.size()});
  });
  return static_cast<int>(ExitCode::kDone);
}

}  // namespace burin::host
