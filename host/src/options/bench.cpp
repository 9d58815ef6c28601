#include "options/bench.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "burin/common/error.hpp"
#include "options/volume_input.hpp"

namespace burin::host {

void addBenchOptions(OptionList& list, BenchOptions& options, const std::string& quick) {
  addInput(list, options.input);
  addVolume(list, options.volume);
  list.path("--out", options.folder, "DIR", "Where the table and the plots go (bench)");
  list.flag("--quick", options.quick, quick);
}

Option addRepeats(OptionList& list, int& repeats, int least) {
  return list.integer("--repeats", repeats, least, 10'000,
                      fmt::format("Times of which the median is taken ({})", repeats));
}

Option addFrameSize(OptionList& list, int& side) {
  return list.integer("--size", side, 1, kLargestImageSide,
                      fmt::format("Side of the square frames ({})", side));
}

void checkBuiltInSize(const BenchOptions& options, const Option& size, int side) {
  checkVolumeChoice(options.input, options.volume);
  const bool isBuiltIn = options.input.empty() && options.volume.empty();
  if (!isBuiltIn && size.isGiven())
    fail(ExitCode::kUsage, "--size {} goes with the built-in volumes, not with a scene or volume",
         side);
}

void sortUnique(std::vector<int>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace burin::host
