#include "cost_timeline.hpp"

namespace burin::compositor {

double gatherEnd(std::span<const FinishedPiece> pieces, double time, const Machine& machine,
                 Cores& cores) {
  Link in;
  for (const FinishedPiece& piece : pieces) {
    const double work = handling(machine, piece.bytes);
    const double sent = cores.compute(piece.time, work) + machine.link.latency;
    time = std::max(time, in.carry(machine.link, sent, piece.bytes));
    time = cores.compute(time, work);
  }
  return time;
}

}  // namespace burin::compositor
