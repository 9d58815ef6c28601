#pragma once

#include <string>

#include "bench/frame_model.hpp"

namespace burin::host::bench {

/// model_scaling.csv: predicted milliseconds of a 1024² frame on 2, 4, 8 … 65,536 ranks, for full
/// frames ("dense") and bricks of a volume that covers a fifth of it ("sparse"), with swap, radix-k
/// and direct send; by the link and work rates of `model`, each rank a processor of its own. With
/// the gather, the all-gather of notices and the final agreement.
std::string scalingCsv(const FrameModel& model);

/// A gnuplot script that draws model_scaling.png from it.
std::string scalingPlot();

}  // namespace burin::host::bench
