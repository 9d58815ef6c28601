#include <memory>

#include "options/bench.hpp"
#include "options/describe.hpp"

namespace burin::host {

namespace {

constexpr const char* kRatesFooter =
    R"(Draws each scene as it is and with opacities times 0.03, plain and with tone and edges, and in
turns the same program where all its lanes are busy from the first round to the last: everything
shows, a parallel view fills the frame, nothing is skipped and no ray ends. How many of its samples
per second the scene's frame reaches is what divergence, skipping and short rays leave. Samples are
counted in frames that are not timed. Writes rates.csv and a plot (gnuplot) to the folder, and prints
how the targets fare.

burin bench rates *.nrrd      volumes are drawn with scenes made from their histograms)";

}  // namespace

Finish describeBenchRates(OptionList& list) {
  const auto options = std::make_shared<BenchRatesOptions>();
  list.positionals("INPUT", options->inputs, "FILE",
                   "Scenes (.json) and volumes (the procedural head)");
  list.path("--out", options->folder, "DIR", "Where the table and the plots go (bench)");
  list.flag("--quick", options->quick, "Frames of 128x128 pixels, a head of 64x64x64 voxels");
  addRepeats(list, options->repeats, 5);
  const Option size = addFrameSize(list, options->side);
  list.footer(kRatesFooter);
  return [options, size](int) {
    if (options->quick && !size.isGiven()) options->side = 128;
    return *options;
  };
}

}  // namespace burin::host
