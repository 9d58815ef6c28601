#include "burin/compositor/cost_model.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace burin::compositor {
namespace {

constexpr double kPixels = 1 << 20;
constexpr WireSize kBytes{1.0, 0.0};
constexpr Machine kMachine{{1e-4, 1e-5, 0.0, 1e-8}, {2e-9, 0.0}, 0};

// Ready-made: as many positions as pieces, so that all pieces are equal.
LazySchedule schedule(const ScheduleOptions& options, int participants) {
  const int pieces = pieceCount(options, participants);
  return lazySchedule(options, participants, evenCuts(static_cast<std::size_t>(pieces), pieces));
}

Prediction dense(const ScheduleOptions& options, int n, const Machine& machine, int root = 0) {
  const LazySchedule s = schedule(options, n);
  return predict(s, activePixels(denseWorkload(n, s.all, kPixels)), kBytes, machine, root);
}

double relative(double expected) {
  return 1e-9 * expected;
}

TEST(CostModel, BinarySwapInClosedForm) {
  double expected = 0.0;
  const auto& [link, compute, cores] = kMachine;
  for (int k = 1; k <= 10; ++k) {
    const double b =
        kPixels / std::exp2(k);  // exchanged in round k; o, L, o and the bytes' G and c
    expected +=
        2 * link.overhead + link.latency + b * link.gapPerByte + b * compute.perCombinedPixel;
    const Prediction p = dense({ScheduleKind::kBinarySwap}, 1 << k, kMachine);
    EXPECT_NEAR(p.compositeSeconds, expected, relative(expected)) << k;
    EXPECT_EQ(p.mostMessages, k);
    EXPECT_EQ(p.mostRounds, k);
    EXPECT_EQ(p.bytes, (std::exp2(k) - 1.0) * kPixels);
    // Then the root's link in carries the other pieces, and it takes up the last.
    const double n = std::exp2(k);
    const double gather =
        2 * link.overhead + link.latency + (n - 1) / n * kPixels * link.gapPerByte;
    if (kPixels / n * link.gapPerByte > link.overhead) {
      EXPECT_NEAR(p.gatherSeconds, gather, relative(gather)) << k;
    }
  }
}

TEST(CostModel, SerialGatherInClosedForm) {
  const auto& [link, compute, cores] = kMachine;
  for (const int n : {2, 3, 10}) {
    const double messages = n - 1;
    const double expected = link.overhead + link.latency + messages * kPixels * link.gapPerByte +
                            messages * (link.overhead + kPixels * compute.perCombinedPixel);
    const Prediction p = dense({ScheduleKind::kSerialGather}, n, kMachine);
    EXPECT_NEAR(p.compositeSeconds, expected, relative(expected));
    EXPECT_EQ(p.gatherSeconds, 0.0);
    EXPECT_EQ(p.mostReceivedBytes, messages * kPixels);
  }
}

TEST(CostModel, DirectSendIsBoundByItsLinks) {
  const auto& [link, compute, cores] = kMachine;
  for (const int n : {2, 4, 16}) {
    const double b = kPixels / n;  // all links always busy after the first overhead
    const double expected = link.overhead + link.latency + (n - 1) * b * link.gapPerByte +
                            (n - 1) * (link.overhead + b * compute.perCombinedPixel);
    EXPECT_NEAR(dense({ScheduleKind::kDirectSend}, n, kMachine).compositeSeconds, expected,
                relative(expected));
  }
}

TEST(CostModel, GapKeepsShortMessagesApart) {
  Machine machine{{0.0, 0.0, 1e-3, 0.0}, {}, 0};
  EXPECT_NEAR(dense({ScheduleKind::kSerialGather}, 11, machine).compositeSeconds, 9e-3, 1e-12);
  EXPECT_NEAR(dense({ScheduleKind::kDirectSend}, 11, machine).compositeSeconds, 9e-3, 1e-12);
}

// Without a network a frame is its work divided by the cores that share it.
TEST(CostModel, SharedCoresDivideTheWork) {
  const Machine alone{{}, {1e-9, 0.0}, 0};
  Machine shared = alone;
  const double own = dense({ScheduleKind::kBinarySwap}, 8, alone).compositeSeconds;
  for (const int cores : {1, 2, 4, 8}) {
    shared.cores = cores;
    EXPECT_NEAR(dense({ScheduleKind::kBinarySwap}, 8, shared).compositeSeconds, own * 8 / cores,
                relative(own));
  }
}

TEST(CostModel, EncodingCountsOnBothSides) {
  const Machine machine{{}, {0.0, 1e-9}, 0};
  EXPECT_NEAR(dense({ScheduleKind::kBinarySwap}, 2, machine).compositeSeconds, kPixels * 1e-9,
              1e-12);
}

// A rest beside the base costs little more than the base alone; folding would double the bytes.
TEST(CostModel, AnyCountIsNearPowersOfTwo) {
  const double at16 = dense({ScheduleKind::kBinarySwap}, 16, kMachine).seconds();
  const double at64 = dense({ScheduleKind::kBinarySwap}, 64, kMachine).seconds();
  for (int n = 17; n < 64; ++n) {
    const double share = std::log2(n / 16.0) / 2.0;
    EXPECT_LE(dense({ScheduleKind::kBinarySwap}, n, kMachine).seconds(),
              1.15 * ((1 - share) * at16 + share * at64))
        << n;
  }
}

TEST(CostModel, FollowingOneIsFollowingAllWhereAllAreAlike) {
  for (const ScheduleKind kind : {ScheduleKind::kBinarySwap, ScheduleKind::kRadixK,
                                  ScheduleKind::kDirectSend, ScheduleKind::kSerialGather}) {
    for (const int n : {1, 2, 6, 13, 16, 30}) {
      for (const int root : {0, kNoParticipant}) {
        const LazySchedule s = schedule({kind}, n);
        const auto pixels = activePixels(volumeWorkload(n, s.all, kPixels));
        const Prediction all = predict(s, pixels, {16.0, 40.0}, kMachine, root);
        const Prediction one = predictAlike(s, pixels, {16.0, 40.0}, kMachine, root);
        EXPECT_NEAR(one.compositeSeconds, all.compositeSeconds, relative(all.compositeSeconds));
        EXPECT_NEAR(one.seconds(), all.seconds(), relative(all.seconds())) << n;
        if (kind == ScheduleKind::kSerialGather) continue;
        EXPECT_NEAR(one.bytes, all.bytes, relative(all.bytes));
        EXPECT_EQ(one.messages, all.messages);
      }
    }
  }
}

TEST(CostModel, FollowingOneIsCloseWithARest) {
  for (const int n : {17, 29, 31, 61, 127}) {
    const LazySchedule s = schedule({ScheduleKind::kBinarySwap}, n);
    const auto pixels = activePixels(denseWorkload(n, s.all, kPixels));
    const double all = predict(s, pixels, kBytes, kMachine).seconds();
    EXPECT_NEAR(predictAlike(s, pixels, kBytes, kMachine).seconds(), all, 0.1 * all) << n;
  }
}

TEST(CostModel, UnsoundScheduleIsRefused) {
  Schedule s = makeSchedule({ScheduleKind::kBinarySwap}, 4, evenCuts(8, 4));
  s.plans[1].steps.erase(s.plans[1].steps.begin());
  EXPECT_THROW(
      predict(lazySchedule(s), activePixels(denseWorkload(4, s.all, 100.0)), kBytes, kMachine),
      std::logic_error);
}

TEST(Workload, EndsOfThePowerLaw) {
  const Region all{0, 64};
  const auto everything = activePixels(denseWorkload(16, all, 100.0));
  EXPECT_NEAR(everything(all, 0, 1), 100.0, 1e-9);
  EXPECT_NEAR(everything({0, 16}, 0, 16), 25.0, 1e-9);
  const auto apart = activePixels(disjointWorkload(16, all, 160.0));
  EXPECT_NEAR(apart(all, 3, 4), 10.0, 1e-9);
  EXPECT_NEAR(apart(all, 4, 8), 40.0, 1e-9);
  EXPECT_NEAR(apart(all, 0, 16), 160.0, 1e-9);
}

// A unit cube in n^3 bricks seen along an axis: each shows n^-2 of the picture, 8 of them (a cube
// of twice the edge) four times that, all of them all of it.
TEST(Workload, BricksOfAVolume) {
  const Region all{0, 1};
  const auto pixels = activePixels(volumeWorkload(512, all, 64.0));
  EXPECT_NEAR(pixels(all, 0, 1), 1.0, 1e-9);
  EXPECT_NEAR(pixels(all, 0, 8), 4.0, 1e-9);
  EXPECT_NEAR(pixels(all, 0, 512), 64.0, 1e-9);
}

}  // namespace
}  // namespace burin::compositor
