#include "bench/frame_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "bench/work_rates.hpp"
#include "burin/compositor/frame_notice.hpp"

namespace burin::host::bench {

namespace {

using compositor::FrameTrace;
using compositor::TraceStep;

/// On every rank the traces of all.
std::vector<FrameTrace> gatherTraces(const Communicator& comm, const FrameTrace& mine) {
  const auto lengths = allGather(comm, mine.size());
  const std::size_t longest = *std::ranges::max_element(lengths);
  FrameTrace padded = mine;
  padded.resize(longest);
  const auto bytes = allGatherBytes(comm, std::as_bytes(std::span{padded}));
  std::vector<FrameTrace> traces;
  for (std::size_t rank = 0; rank < lengths.size(); ++rank) {
    FrameTrace& trace = traces.emplace_back(lengths[rank]);
    std::memcpy(trace.data(), bytes.data() + rank * longest * sizeof(TraceStep),
                trace.size() * sizeof(TraceStep));
  }
  return traces;
}

}  // namespace

FrameModel makeFrameModel(const Communicator& comm, const CompositingInput& input,
                          const compositor::LogGP& link, int cores) {
  FrameModel model{input.name, input.mine.frame, comm.size(), {}};
  model.machine.link = link;
  model.machine.work = measureWorkRates(comm, input.mine);
  model.machine.cores = cores;
  return model;
}

double predictedMs(const Communicator& comm, const Contender& contender, const FrameModel& model) {
  if (contender.lastTrace() == nullptr) return 0.0;
  auto traces = gatherTraces(comm, *contender.lastTrace());
  if (!comm.isRoot()) return 0.0;
  const std::int64_t noticeBytes = compositor::noticeBytes(comm.size());
  for (int rank = 0; rank < comm.size(); ++rank) {
    FrameTrace& trace = traces[static_cast<std::size_t>(rank)];
    trace = compositor::withCollectives(trace, rank, comm.size(), noticeBytes);
  }
  return 1e3 * compositor::replay(traces, model.machine);
}

std::string modelCsv(std::span<const FrameModel> models) {
  std::string text =
      "case,ranks,width,height,cores,latency_us,overhead_us,gap_us,gap_ns_per_byte,"
      "scan_ns_per_pixel,combine_ns_per_pixel,paste_ns_per_pixel,encode_ns_per_byte,"
      "decode_ns_per_byte,pack_ns_per_byte,unpack_ns_per_byte\n";
  for (const FrameModel& model : models) {
    const auto& [link, work, cores, eager] = model.machine;
    text += fmt::format(
        "{},{},{},{},{},{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},"
        "{:.4f}\n",
        model.input, model.ranks, model.frame.width, model.frame.height, cores, 1e6 * link.latency,
        1e6 * link.overhead, 1e6 * link.gap, 1e9 * link.gapPerByte, 1e9 * work.perScannedPixel,
        1e9 * work.perCombinedPixel, 1e9 * work.perPastedPixel, 1e9 * work.perEncodedByte,
        1e9 * work.perDecodedByte, 1e9 * work.perPackedByte, 1e9 * work.perUnpackedByte);
  }
  return text;
}

}  // namespace burin::host::bench
