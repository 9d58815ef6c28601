#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/compositing_input.hpp"
#include "bench/contender.hpp"
#include "burin/compositor/replay.hpp"

namespace burin::host::bench {

/// What frames of one input are predicted from.
struct FrameModel {
  std::string input;
  ImageSize frame;
  int ranks = 0;
  compositor::ReplayMachine machine;
};

/// Collective. `link`: measured between the ranks of `comm`; `cores`: as in ReplayMachine. Measures
/// the rest on `input`.
FrameModel makeFrameModel(const Communicator& comm, const CompositingInput& input,
                          const compositor::LogGP& link, int cores);

/// Collective. Milliseconds that the model gives for the contender's last frame, with its exact
/// messages; 0 for a contender without a trace, and on ranks other than 0.
double predictedMs(const Communicator& comm, const Contender& contender, const FrameModel& model);

/// model.csv: a header line and a line per model; see ReplayMachine.
std::string modelCsv(std::span<const FrameModel> models);

}  // namespace burin::host::bench
