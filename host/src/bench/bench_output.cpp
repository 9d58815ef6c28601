#include "bench/bench_output.hpp"

#include <cstdio>

#include "bench/gnuplot.hpp"
#include "burin/common/log.hpp"
#include "burin/common/temporary_file.hpp"

namespace burin::host::bench {

void publish(const std::filesystem::path& folder, const BenchOutput& output) {
  const std::string table = output.name + ".csv";
  const std::string script = output.name + ".gp";
  writeTextFile(folder / table, output.csv);
  writeTextFile(folder / script, output.plots);
  std::fputs(output.summary.c_str(), stdout);
  if (!runGnuplot(folder, script))
    warn("gnuplot is not installed (scripts/setup bench), so there are no plots");
  note("{}: {} measurements", (folder / table).string(), output.measurements);
}

}  // namespace burin::host::bench
