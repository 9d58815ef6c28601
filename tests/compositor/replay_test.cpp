#include "burin/compositor/replay.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "burin/compositor/in_process_executor.hpp"

namespace burin::compositor {
namespace {

using Kind = TraceStep::Kind;
using Channel = TraceStep::Channel;

TraceStep sendTo(int peer, std::int64_t bytes, Channel channel = Channel::kSwap) {
  return {
      .kind = Kind::kSend, .channel = channel, .peer = peer, .bytes = bytes, .wireBytes = bytes};
}
TraceStep receiveFrom(int peer, Channel channel = Channel::kSwap) {
  return {.kind = Kind::kReceive, .channel = channel, .peer = peer};
}
TraceStep work(Kind kind, std::int64_t pixels) {
  return {.kind = kind, .pixels = pixels};
}

// Powers of two, so that sums are exact.
constexpr LogGP kLink{.latency = 8.0, .overhead = 2.0, .gap = 0.0, .gapPerByte = 0.5};

TEST(Replay, OneMessageCostsWhatLogGPSays) {
  const ReplayMachine machine{.link = kLink, .work = {.perCombinedPixel = 0.25}};
  const std::vector<FrameTrace> traces{{sendTo(1, 64)}, {receiveFrom(0), work(Kind::kCombine, 16)}};
  // o, then 64 G on the link, L, o again, and 16 pixels.
  EXPECT_EQ(replay(traces, machine), 2.0 + 32.0 + 8.0 + 2.0 + 4.0);
}

TEST(Replay, LongMessagesWaitForTheReceiver) {
  const ReplayMachine machine{.link = kLink, .work = {.perScannedPixel = 1.0}, .eagerBytes = 32.0};
  const std::vector<FrameTrace> traces{
      {sendTo(1, 64)}, {work(Kind::kScan, 100), receiveFrom(0), work(Kind::kCombine, 0)}};
  // The receiver is there at 100; 2 L later the message leaves.
  EXPECT_EQ(replay(traces, machine), 100.0 + 16.0 + 32.0 + 8.0 + 2.0);
}

TEST(Replay, TheRootsLinkCarriesOneMessageAtATime) {
  const ReplayMachine machine{.link = kLink};
  std::vector<FrameTrace> traces(4);
  for (int rank = 1; rank < 4; ++rank) {
    traces[static_cast<std::size_t>(rank)] = {sendTo(0, 64, Channel::kGather)};
    traces[0].push_back(receiveFrom(rank, Channel::kGather));
  }
  EXPECT_EQ(replay(traces, machine), 2.0 + 8.0 + 3 * 32.0 + 2.0);
}

TEST(Replay, SharedCoresTakeTurns) {
  const std::vector<FrameTrace> traces(4, {work(Kind::kScan, 10)});
  EXPECT_EQ(replay(traces, {.work = {.perScannedPixel = 1.0}}), 10.0);
  EXPECT_EQ(replay(traces, {.work = {.perScannedPixel = 1.0}, .cores = 2}), 20.0);
}

TEST(Replay, PackedMessagesTravelShorterAndCostWork) {
  const ReplayMachine machine{.link = kLink, .work = {.perPackedByte = 0.125}};
  TraceStep packed = sendTo(1, 64);
  packed.isPacked = 1;
  packed.wireBytes = 32;
  const std::vector<FrameTrace> traces{{packed}, {receiveFrom(0), work(Kind::kCombine, 0)}};
  EXPECT_EQ(replay(traces, machine), 2.0 + 8.0 + 16.0 + 8.0 + 2.0);
}

// Whatever the rank count, what collectives add can be replayed to the end.
TEST(Replay, CollectivesMatch) {
  for (int ranks = 1; ranks <= 33; ++ranks) {
    std::vector<FrameTrace> traces;
    for (int rank = 0; rank < ranks; ++rank)
      traces.push_back(withCollectives({}, rank, ranks, 1000));
    EXPECT_GE(replay(traces, {.link = kLink}), 0.0) << ranks;
  }
}

// What the trace says was sent is what the participants counted, and it can be replayed.
TEST(Replay, TracesHaveTheExactBytes) {
  for (int ranks = 2; ranks <= 9; ++ranks) {
    const ImageSize size{64, 48};
    std::vector<Subimage<Rgba>> images;
    std::vector<Rank> order;
    for (int rank = 0; rank < ranks; ++rank) {
      const PixelRect active{rank, 0, rank + 40, 48};
      images.push_back({size, active, std::vector<Rgba>(active.pixels(), {0, 0, 0, 0.5f})});
      order.push_back(Rank{rank});
    }
    for (const ScheduleKind kind : {ScheduleKind::kBinarySwap, ScheduleKind::kRadixK,
                                    ScheduleKind::kDirectSend, ScheduleKind::kSerialGather}) {
      CompositeOptions options;
      options.schedule = ScheduleOptions{kind};
      options.isSharingMemory = false;
      const auto result = compositeInProcess<Over>(options, size, order, images);
      for (std::size_t rank = 0; rank < result.traces.size(); ++rank) {
        std::int64_t sent = 0;
        for (const TraceStep& step : result.traces[rank]) sent += step.wireBytes;
        EXPECT_EQ(sent, result.traffic[rank].bytesSent);
      }
      EXPECT_GT(replay(result.traces, {.link = kLink}), 0.0);
    }
  }
}

}  // namespace
}  // namespace burin::compositor
