#include <memory>

#include "options/bench.hpp"
#include "options/describe.hpp"

namespace burin::host {

namespace {

constexpr const char* kScalingFooter =
    R"(Mode "isolated": rank 0 cuts the volume as for 1, 2, 4 … ranks and draws each rank's brick by itself
with all threads; a frame is the slowest of them and what the cost model says of merging what they
drew over a fast network. Mode "wall": whole frames on 1, 2, 4 … of the ranks that burin was started
with, up to the cores there are.

Strong scaling of one scene (INPUT if it is given); without INPUT also weak scaling, the volume growing
with the ranks, and Lum and Ma's case: a volume of twice --size on 8 ranks and a host, with tone and
edges in one layer and in two. Writes scaling.csv and a plot (gnuplot) to the folder.

mpirun --bind-to none -n 2 burin bench scaling      with wall times on 1 and 2 ranks)";

BenchScalingOptions finished(BenchScalingOptions options, const Option& size) {
  checkBuiltInSize(options, size, options.side);
  if (options.quick && !size.isGiven()) options.side = 64;
  if (options.bricks.empty()) {
    for (int ranks = 1; ranks <= (options.quick ? 32 : 256); ranks *= 2)
      options.bricks.push_back(ranks);
  }
  sortUnique(options.bricks);
  return options;
}

}  // namespace

Finish describeBenchScaling(OptionList& list) {
  const auto options = std::make_shared<BenchScalingOptions>();
  addBenchOptions(list, *options, "64x64x64 voxels, up to 32 ranks");
  list.integers("--bricks", options->bricks, 1, 4096,
                "Numbers of ranks whose bricks are drawn one by one (1,2,4,…,256)");
  addRepeats(list, options->repeats, 1);
  const Option size =
      list.integer("--size", options->side, 16, 512,
                   "Voxels along each axis of the built-in volume (256); twice as many for Lum and "
                   "Ma's, a quarter for each rank of weak scaling");
  list.footer(kScalingFooter);
  return [options, size](int) { return finished(*options, size); };
}

}  // namespace burin::host
