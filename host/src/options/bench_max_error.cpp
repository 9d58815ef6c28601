#include <memory>

#include "options/bench.hpp"
#include "options/describe.hpp"

namespace burin::host {

namespace {

constexpr const char* kMaxErrorFooter =
    R"(Asks for errors of 1/32, 1/128 and 1/512 in three views of each volume, with a smooth and a spiky
transfer function, and compares every pixel with the double-precision reference, halved until it has
converged. Then draws at fixed steps of 4, 2, 1 … voxels until one is as good, and compares the
samples, those that were needed to choose the steps included. Writes max_error.csv to the folder.

burin bench max-error *.nrrd      takes minutes per volume)";

}  // namespace

Finish describeBenchMaxError(OptionList& list) {
  const auto options = std::make_shared<BenchMaxErrorOptions>();
  list.positionals("VOLUME", options->volumes, "FILE", "Volumes (the procedural kinds)");
  list.path("--out", options->folder, "DIR", "Where the table goes (bench)");
  list.flag("--quick", options->quick, "Frames of 64x64 pixels, one view");
  list.number("--smallest-step", options->smallestStep, kSmallestStepVoxels, kLargestChosenStep,
              "Smallest fixed step to compare with, voxels (1/64)");
  const Option size = addFrameSize(list, options->side);
  list.footer(kMaxErrorFooter);
  return [options, size](int) {
    if (options->quick && !size.isGiven()) options->side = 64;
    return *options;
  };
}

}  // namespace burin::host
