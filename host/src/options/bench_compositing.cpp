#include <memory>

#include "burin/common/error.hpp"
#include "options/bench.hpp"
#include "options/describe.hpp"
#include "options/volume_input.hpp"

namespace burin::host {

namespace {

constexpr const char* kCompositingFooter =
    R"(Composites the same subimages with burin and, where it is found, with IceT, in turns: a scene's
footprints (built-in scenes unless INPUT is given), full frames, and discs of growing size. Writes
compositing.csv and plots (gnuplot) to the folder, and prints the ratios to IceT's best.

Start it with as many ranks as are to be measured: mpirun --bind-to none -n 8 burin bench compositing
`scripts/get-icet` fetches IceT; another one is found by BURIN_ICET_FOLDER=FOLDER.)";

void checkNetwork(const std::string& name) {
  if (name.find_first_of(",\"\r\n") != std::string::npos)
    fail(ExitCode::kUsage, "--network {}: expected a name without commas, quotes or line ends",
         name);
}

/// Those that were asked for, checked, or a choice.
std::vector<int> rankCounts(std::vector<int> asked, int ranks) {
  for (const int wanted : asked) {
    if (wanted < 2 || wanted > ranks)
      fail(ExitCode::kUsage, "--ranks {}: expected 2 to {}, as many as this run has", wanted,
           ranks);
  }
  if (asked.empty()) {
    for (int some = 2; some <= std::min(ranks, 8); ++some) asked.push_back(some);
    asked.push_back(ranks);
  }
  sortUnique(asked);
  return asked;
}

BenchCompositingOptions finished(BenchCompositingOptions options, const Option& repeats,
                                 int ranks) {
  if (ranks < 2)
    fail(ExitCode::kUsage, "bench compositing needs two ranks or more, this run has one");
  checkVolumeChoice(options.input, options.volume);
  checkNetwork(options.network);
  options.ranks = rankCounts(options.ranks, ranks);
  if (options.sides.empty())
    options.sides = options.quick ? std::vector{512} : std::vector{512, 1024, 2048};
  sortUnique(options.sides);
  if (options.quick && !repeats.isGiven()) options.repeats = 3;
  return options;
}

}  // namespace

Finish describeBenchCompositing(OptionList& list) {
  const auto options = std::make_shared<BenchCompositingOptions>();
  addBenchOptions(list, *options, "512x512 and 3 repeats, no discs");
  list.integers("--ranks", options->ranks, "Rank counts (2 to 8, and all)");
  list.integers("--sizes", options->sides, 1, kLargestImageSide,
                "Sides of the square frames (512,1024,2048)");
  const Option repeats = addRepeats(list, options->repeats, 1);
  list.flag("--dedicated-host", options->dedicatedHost, "Rank 0 draws nothing");
  list.text("--network", options->network, "NAME",
            "What the table calls the network (shm if all ranks share memory)");
  list.footer(kCompositingFooter);
  return [options, repeats](int ranks) { return finished(*options, repeats, ranks); };
}

}  // namespace burin::host
