#include <memory>

#include "options/bench.hpp"
#include "options/describe.hpp"

namespace burin::host {

namespace {

constexpr const char* kSkipFooter =
    R"(Draws one ball, 30 balls and vessels with empty-space skipping on and off, in turns with a volume
in which everything is visible; or only INPUT, if it is given. Samples are counted in frames that
are not timed. Writes skip.csv and a plot (gnuplot) to the folder, and prints how the targets fare.

One rank is what it is meant for; on more the time is the slowest rank's.)";

}  // namespace

Finish describeBenchSkip(OptionList& list) {
  const auto options = std::make_shared<BenchSkipOptions>();
  addBenchOptions(list, *options, "96x96x96 voxels and fewer fractions");
  addRepeats(list, options->repeats, 5);
  const Option size = list.integer(
      "--size", options->side, 16, 1024,
      "Voxels along each axis of the built-in volumes (256); the frame is twice as wide");
  list.footer(kSkipFooter);
  return [options, size](int) {
    checkBuiltInSize(*options, size, options->side);
    if (options->quick && !size.isGiven()) options->side = 96;
    return *options;
  };
}

}  // namespace burin::host
