#include "burin/compositor/composite.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "burin/compositor/in_process_executor.hpp"
#include "support/mpi_test.hpp"
#include "test_images.hpp"

namespace burin::compositor {
namespace {

using burin::test::world;
using test::Affine;

int rankIndex() {
  return static_cast<int>(world().rank());
}

/// All ranks in an order that depends on the seed only.
std::vector<Rank> shuffledRanks(unsigned seed) {
  std::vector<Rank> order;
  for (int i = 0; i < world().size(); ++i) order.push_back(Rank{i});
  test::Random random{seed};
  for (int i = world().size() - 1; i > 0; --i) {
    std::swap(order[static_cast<std::size_t>(i)],
              order[static_cast<std::size_t>(test::below(random, i + 1))]);
  }
  return order;
}

template <typename Pixel>
std::vector<Subimage<Pixel>> frontToBack(const std::vector<Subimage<Pixel>>& byRank,
                                         const std::vector<Rank>& order) {
  std::vector<Subimage<Pixel>> sorted;
  for (const Rank rank : order) {
    const auto& image = byRank[static_cast<std::size_t>(rank)];
    if (!image.active.empty()) sorted.push_back(image);
  }
  return sorted;
}

template <PixelAlgebra A>
std::optional<Image<typename A::Pixel>> composed(
    const CompositeOptions& options, const std::vector<Rank>& order,
    const std::vector<Subimage<typename A::Pixel>>& byRank, RankStatistics& statistics) {
  return compositeToRoot<A>(world(), options, order, byRank[static_cast<std::size_t>(rankIndex())],
                            {}, statistics);
}

class Composite : public testing::TestWithParam<ScheduleKind> {
 protected:
  CompositeOptions options_{GetParam(), Rank{0}};
  RankStatistics statistics_;
};

TEST_P(Composite, EqualsSerialCombinationExactly) {
  unsigned seed = 0;
  for (const ImageSize frame : {ImageSize{1, 1}, ImageSize{64, 31}, ImageSize{997, 1}}) {
    for (int trial = 0; trial < 4; ++trial, ++seed) {
      const auto order = shuffledRanks(seed);
      const auto byRank = test::randomSubimages<Affine>(frame, world().size(), seed);
      options_.root = Rank{trial % world().size()};
      const auto image = composed<Affine>(options_, order, byRank, statistics_);
      ASSERT_EQ(image.has_value(), world().rank() == options_.root);
      if (!image) continue;
      EXPECT_TRUE(
          test::areEqual(*image, test::combineSerially<Affine>(frame, frontToBack(byRank, order))))
          << "seed " << seed;
    }
  }
}

TEST_P(Composite, OverEqualsTheInProcessExecutorBitForBitAndTwice) {
  const ImageSize frame{509, 503};
  const auto order = shuffledRanks(5);
  const auto byRank = test::randomSubimages<Over>(frame, world().size(), 6);
  const auto image = composed<Over>(options_, order, byRank, statistics_);
  const auto again = composed<Over>(options_, order, byRank, statistics_);
  if (!world().isRoot()) return;
  const auto images = frontToBack(byRank, order);
  const PixelRect bounds = test::boundsOf(images);
  const auto schedule =
      makeSchedule(GetParam(), static_cast<int>(images.size()), {0, bounds.pixels()});
  const auto expected = assemble(executeInProcess<Over>(schedule, bounds, images), frame);
  const auto areSameBits = [](const Image<Rgba>& a, const Image<Rgba>& b) {
    return std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
  };
  EXPECT_TRUE(areSameBits(*image, expected));
  EXPECT_TRUE(areSameBits(*image, *again));
}

TEST_P(Composite, RootNeedNotTakePart) {
  const ImageSize frame{40, 30};
  for (int root = 0; root < world().size(); ++root) {
    options_.root = Rank{root};
    auto byRank = test::randomSubimages<Affine>(frame, world().size(), 9);
    byRank[static_cast<std::size_t>(root)] = {frame, {}, {}};
    auto order = shuffledRanks(10);
    std::erase(order, Rank{root});
    const auto image = composed<Affine>(options_, order, byRank, statistics_);
    if (rankIndex() != root) continue;
    EXPECT_TRUE(
        test::areEqual(*image, test::combineSerially<Affine>(frame, frontToBack(byRank, order))));
  }
}

TEST_P(Composite, NothingDrawnAnywhere) {
  const ImageSize frame{6, 5};
  const std::vector<Subimage<Affine::Pixel>> byRank(static_cast<std::size_t>(world().size()),
                                                    {frame, {}, {}});
  const auto image = composed<Affine>(options_, shuffledRanks(1), byRank, statistics_);
  if (world().isRoot()) {
    EXPECT_TRUE(std::ranges::all_of(image->pixels(), Affine::isIdentity));
  }
  EXPECT_EQ(statistics_.messagesSent, 0);
  EXPECT_EQ(statistics_.bytesSent, 0);
  EXPECT_EQ(statistics_.bytesReceived, 0);
}

// A rank whose rectangle is loose and blank takes no part, whatever its size.
TEST_P(Composite, BlankPixelsAreNotSent) {
  const ImageSize frame{50, 40};
  std::vector<Subimage<Rgba>> byRank(static_cast<std::size_t>(world().size()),
                                     {frame, {0, 0, 50, 40}, std::vector<Rgba>(2000)});
  byRank.back().pixels[777] = {0.5f, 0, 0, 0.5f};
  const auto image = composed<Over>(options_, shuffledRanks(2), byRank, statistics_);
  const bool isLast = rankIndex() == world().size() - 1;
  const bool sends = isLast && !world().isRoot();
  EXPECT_EQ(statistics_.messagesSent, sends ? 1 : 0);
  EXPECT_EQ(statistics_.bytesSent,
            sends ? static_cast<std::int64_t>(shareBytes(1, Over::kWireBytes)) : 0);
  if (world().isRoot()) {
    EXPECT_EQ(image->pixels()[777], (Rgba{0.5f, 0, 0, 0.5f}));
  }
}

TEST_P(Composite, CountsAreThoseOfTheScheduleAndTheGather) {
  const ImageSize frame{61, 47};
  const auto order = shuffledRanks(11);
  const auto byRank = test::randomSubimages<Over>(frame, world().size(), 12);
  composed<Over>(options_, order, byRank, statistics_);

  const auto images = frontToBack(byRank, order);
  const PixelRect bounds = test::boundsOf(images);
  const auto schedule =
      makeSchedule(GetParam(), static_cast<int>(images.size()), {0, bounds.pixels()});
  auto participants = executeInProcess<Over>(schedule, bounds, images);
  Traffic expected;
  std::int64_t gathered = 0;
  std::size_t i = 0;
  for (const Rank rank : order) {
    if (byRank[static_cast<std::size_t>(rank)].active.empty()) continue;
    const Region owned = schedule.plans[i].owned;
    auto& participant = participants[i++];
    if (rank != options_.root && !owned.empty()) {
      gathered += static_cast<std::int64_t>(participant.encode(owned).bytes().size());
    }
    if (rank == world().rank()) expected = participant.traffic();
  }
  if (world().rank() == options_.root) expected.bytesReceived += gathered;
  EXPECT_EQ(statistics_.bytesSent, expected.bytesSent);
  EXPECT_EQ(statistics_.bytesReceived, expected.bytesReceived);
  EXPECT_EQ(statistics_.messagesSent, expected.messagesSent);
}

TEST_P(Composite, DrawingFailsOnAnyRank) {
  const ImageSize frame{20, 10};
  for (int culprit = 0; culprit < world().size(); ++culprit) {
    test::Random random{static_cast<unsigned>(rankIndex())};
    Subimage<Rgba> mine;  // a failed rank may not even know the frame size
    Outcome drawing;
    if (rankIndex() == culprit) {
      drawing = {true, ExitCode::kVolume, fmt::format("brick {} is unreadable", culprit)};
    } else {
      mine = test::randomSubimage<Over>(frame, {0, 0, 20, 10}, random);
    }
    try {
      compositeToRoot<Over>(world(), options_, shuffledRanks(3), mine, drawing, statistics_);
      ADD_FAILURE() << "nobody heard of the failure of rank " << culprit;
    } catch (const CollectiveError& e) {
      EXPECT_EQ(e.code(), ExitCode::kVolume);
      EXPECT_EQ(e.culprit(), Rank{culprit});
      EXPECT_EQ(e.what(), fmt::format("drawing: rank {0}: brick {0} is unreadable", culprit));
    }
  }
  // Nothing is left over that a later frame could take for its own.
  const auto byRank = test::randomSubimages<Affine>(frame, world().size(), 13);
  const auto image = composed<Affine>(options_, shuffledRanks(3), byRank, statistics_);
  if (world().isRoot()) {
    EXPECT_TRUE(test::areEqual(
        *image, test::combineSerially<Affine>(frame, frontToBack(byRank, shuffledRanks(3)))));
  }
}

TEST_P(Composite, SubimageThatContradictsItselfIsItsRanksFailure) {
  const int culprit = world().size() - 1;
  Subimage<Rgba> mine{{4, 4}, {0, 0, 2, 2}, std::vector<Rgba>(rankIndex() == culprit ? 3U : 4U)};
  try {
    compositeToRoot<Over>(world(), options_, shuffledRanks(0), mine, {}, statistics_);
    ADD_FAILURE() << "taken";
  } catch (const CollectiveError& e) {
    EXPECT_EQ(e.culprit(), Rank{culprit});
  }
}

std::string complaint(const CompositeOptions& options, const std::vector<Rank>& order,
                      const Subimage<Rgba>& mine) {
  RankStatistics statistics;
  try {
    compositeToRoot<Over>(world(), options, order, mine, {}, statistics);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST_P(Composite, DifferentArgumentsAreRefusedEverywhere) {
  const Subimage<Rgba> mine{{4, 4}, {0, 0, 1, 1}, {{0, 0, 0, 1}}};
  const auto order = shuffledRanks(0);
  auto repeated = order;
  repeated.push_back(order.front());
  EXPECT_NE(complaint(options_, repeated, mine).find("is named twice"), std::string::npos);
  auto unknown = order;
  unknown.push_back(Rank{world().size()});
  EXPECT_NE(complaint(options_, unknown, mine).find("given"), std::string::npos);
  EXPECT_NE(complaint(options_, {}, mine).find("rank 0 drew something but is not in it"),
            std::string::npos);
  if (world().size() == 1) return;
  const bool isOdd = rankIndex() == 1;
  auto otherOrder = order;
  std::swap(otherOrder.front(), otherOrder.back());
  EXPECT_NE(complaint(options_, isOdd ? otherOrder : order, mine).find("rank 1 and rank 0 differ"),
            std::string::npos);
  auto otherSize = mine;
  otherSize.frame.width = 5;
  EXPECT_NE(complaint(options_, order, isOdd ? otherSize : mine).find("rank 1 and rank 0 differ"),
            std::string::npos);
}

// Rank 1 plays a peer whose messages are damaged: rank 0 must neither crash nor hang.
TEST_P(Composite, DamagedMessageIsTheReceiversOutcome) {
  if (world().size() == 1) GTEST_SKIP() << "nobody to receive from";
  const std::vector<Rank> ranks{Rank{0}, Rank{1}};
  const Region all{0, 64};
  const Plan plan = makePlan(GetParam(), 2, all, std::min(rankIndex(), 1));
  if (rankIndex() == 0) {
    test::Random random{1};
    const PixelRect bounds{0, 0, 8, 8};
    Participant<Over> participant{bounds, test::randomSubimage<Over>({8, 8}, bounds, random)};
    executeOverMpi(world(), ranks, plan, participant);
    EXPECT_TRUE(participant.outcome().failed);
    EXPECT_EQ(participant.outcome().reason,
              "message from rank 1: at least 40 bytes expected, 7 received");
  } else if (rankIndex() == 1) {
    MessageBuffer received{shareBytes(64, Over::kWireBytes)};
    MPI_Request request = beginReceive(world(), Rank{0}, Tag::kSwap, received.bytes());
    MessageBuffer damaged{7};
    std::ranges::fill(damaged.bytes(), std::byte{0});
    PendingSend{world(), Rank{0}, Tag::kSwap, std::move(damaged)}.wait();
    finishReceive(request, received.bytes());
  }
  barrier(world());
}

TEST_P(Composite, PhasesAreTimed) {
  const auto byRank = test::randomSubimages<Over>({61, 47}, world().size(), 14);
  composed<Over>(options_, shuffledRanks(1), byRank, statistics_);
  EXPECT_GT(statistics_.phases[Phase::kComposite], 0);
  EXPECT_GT(statistics_.phases[Phase::kGather], 0);
  EXPECT_EQ(statistics_.phases[Phase::kDraw], 0);
}

// All pixels active, N divisible: log2 P messages of N/2, N/4, … pixels, then N/P to the
// root, each with its header.
TEST(BinarySwapTraffic, HasItsClosedForm) {
  const int p = world().size();
  if ((p & (p - 1)) != 0) GTEST_SKIP() << "a power of two is needed";
  const std::int64_t n = 64 * 64;
  test::Random random{static_cast<unsigned>(rankIndex())};
  RankStatistics statistics;
  compositeToRoot<Over>(world(), {}, shuffledRanks(0),
                        test::randomSubimage<Over>({64, 64}, {0, 0, 64, 64}, random), {},
                        statistics);
  std::int64_t messages = 0;
  std::int64_t bytes = 0;
  for (int parts = 2; parts <= p; parts *= 2) {
    ++messages;
    bytes += 40 + 16 * (n / parts);
  }
  const std::int64_t share = 40 + 16 * (n / p);
  EXPECT_EQ(statistics.messagesSent, messages + (world().isRoot() ? 0 : 1));
  EXPECT_EQ(statistics.bytesSent, bytes + (world().isRoot() ? 0 : share));
  EXPECT_EQ(statistics.bytesReceived, bytes + (world().isRoot() ? (p - 1) * share : 0));
}

std::string nameOf(const testing::TestParamInfo<ScheduleKind>& kind) {
  return kind.param == ScheduleKind::kBinarySwap ? "BinarySwap" : "DirectSend";
}
INSTANTIATE_TEST_SUITE_P(, Composite,
                         testing::Values(ScheduleKind::kBinarySwap, ScheduleKind::kDirectSend),
                         nameOf);

}  // namespace
}  // namespace burin::compositor
