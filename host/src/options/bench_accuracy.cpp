#include <memory>

#include "options/bench.hpp"
#include "options/describe.hpp"
#include "options/volume_input.hpp"

namespace burin::host {

namespace {

constexpr const char* kAccuracyFooter =
    R"(Draws the built-in scenes (or INPUT) at fixed steps and for max_error settings, with and without
pre-integration, and as slices: in float, half and byte framebuffers and, not with --quick, with
quantised normals and palettes before filtering. All in turns, compared with the double-precision
reference, which has no step; its own change when it is asked for twice as much is shown. Writes
accuracy.csv and accuracy.png (gnuplot: error against time and samples, the Pareto front marked) to
the folder.)";

}  // namespace

Finish describeBenchAccuracy(OptionList& list) {
  const auto options = std::make_shared<BenchAccuracyOptions>();
  addBenchOptions(list, *options, "Frames of 96x96 pixels, a coarser reference");
  addRepeats(list, options->repeats, 5);
  const Option size = addFrameSize(list, options->side);
  list.footer(kAccuracyFooter);
  return [options, size](int) {
    checkVolumeChoice(options->input, options->volume);
    if (options->quick && !size.isGiven()) options->side = 96;
    return *options;
  };
}

}  // namespace burin::host
