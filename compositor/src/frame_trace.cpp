#include "burin/compositor/frame_trace.hpp"

namespace burin::compositor {

namespace {

using Kind = TraceStep::Kind;
using Channel = TraceStep::Channel;

constexpr std::int64_t kAgreementBytes = 8;

TraceStep message(Kind kind, Channel channel, int peer, std::int64_t bytes) {
  return {.kind = kind, .channel = channel, .peer = peer, .bytes = bytes, .wireBytes = bytes};
}

void addAllGather(FrameTrace& trace, int rank, int ranks, std::int64_t bytes) {
  for (const Kind kind : {Kind::kSend, Kind::kReceive}) {
    for (int peer = 0; peer < ranks; ++peer) {
      if (peer != rank) trace.push_back(message(kind, Channel::kNotice, peer, bytes));
    }
  }
}

/// A binomial tree: in round b those whose lowest set bit is b send to the rank without it.
void addReduction(FrameTrace& trace, int rank, int ranks) {
  int bit = 1;
  for (; bit < ranks && (rank & bit) == 0; bit *= 2) {
    if (rank + bit >= ranks) continue;
    trace.push_back(message(Kind::kReceive, Channel::kAgreement, rank + bit, kAgreementBytes));
    trace.push_back({.kind = Kind::kCombine});
  }
  if (rank == 0) return;
  trace.push_back(message(Kind::kSend, Channel::kAgreement, rank - bit, kAgreementBytes));
}

void addBroadcast(FrameTrace& trace, int rank, int ranks) {
  int bit = 1;
  while (bit < ranks && (rank & bit) == 0) bit *= 2;
  if (rank != 0) {
    trace.push_back(message(Kind::kReceive, Channel::kAgreement, rank - bit, kAgreementBytes));
    trace.push_back({.kind = Kind::kCombine});
  }
  for (bit /= 2; bit > 0; bit /= 2) {
    if (rank + bit >= ranks) continue;
    trace.push_back(message(Kind::kSend, Channel::kAgreement, rank + bit, kAgreementBytes));
  }
}

}  // namespace

FrameTrace withCollectives(const FrameTrace& frame, int rank, int ranks, std::int64_t noticeBytes) {
  FrameTrace trace;
  std::size_t scans = 0;
  while (scans < frame.size() && frame[scans].kind == Kind::kScan) trace.push_back(frame[scans++]);
  addAllGather(trace, rank, ranks, noticeBytes);
  trace.insert(trace.end(), frame.begin() + static_cast<std::ptrdiff_t>(scans), frame.end());
  trace.push_back({.kind = Kind::kFinish});
  addReduction(trace, rank, ranks);
  addBroadcast(trace, rank, ranks);
  return trace;
}

}  // namespace burin::compositor
