#include "burin/compositor/compositor.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <map>
#include <new>

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

/// Kept over frames, as programs do.
Compositor& compositor() {
  static std::optional<Compositor> instance;
  if (!instance) instance.emplace(world());
  return *instance;
}

/// Every second time from the canvas, whose pixels are handed over in place.
template <PixelAlgebra A>
std::optional<Image<typename A::Pixel>> composed(
    const CompositeOptions& options, const std::vector<Rank>& order,
    const std::vector<Subimage<typename A::Pixel>>& byRank, RankStatistics& statistics) {
  using Pixel = typename A::Pixel;
  static int frames = 0;
  const Subimage<Pixel>& drawn = byRank[static_cast<std::size_t>(rankIndex())];
  SubimageView<Pixel> mine{drawn};
  if (++frames % 2 == 0) {
    const auto canvas = compositor().canvas<Pixel>(drawn.frame, drawn.pixels.size());
    std::ranges::copy(drawn.pixels, canvas.begin());
    mine.pixels = canvas;
  }
  const auto view = compositor().toRoot<A>(options, order, mine, {}, statistics);
  if (!view) return std::nullopt;
  Image<Pixel> image{view->size()};
  std::ranges::copy(view->pixels(), image.pixels().begin());
  return image;
}

/// The front-to-back combination of what `order` drew.
template <PixelAlgebra A>
Image<typename A::Pixel> expected(ImageSize frame, const std::vector<Rank>& order,
                                  const std::vector<Subimage<typename A::Pixel>>& byRank) {
  return test::combineSerially<A>(frame, frontToBack(byRank, order));
}

enum class Work { kStore, kLoad, kCombine };

/// Over whose pixels `fails` to be stored, loaded or combined on this rank while it is set.
struct Failing : Over {
  static constexpr bool kWireIsMemory = false;  // so that every pixel is stored and loaded
  static inline std::optional<Work> fails;
  static inline bool hasFailed = false;

  static Rgba combine(const Rgba& front, const Rgba& back) {
    if (isMet(Work::kCombine)) throw std::bad_alloc{};
    return Over::combine(front, back);
  }
  static std::size_t store(const Rgba& pixel, std::span<std::byte> out) {
    if (isMet(Work::kStore)) throw std::bad_alloc{};
    return Over::store(pixel, out);
  }
  static std::size_t load(std::span<const std::byte> in, Rgba& into) {
    return isMet(Work::kLoad) ? 0 : Over::load(in, into);
  }

 private:
  static bool isMet(Work work) {
    hasFailed |= fails == work;
    return fails == work;
  }
};
static_assert(PixelAlgebra<Failing>);

struct Way {
  std::string name;
  CompositeOptions options;
};

class Composite : public testing::TestWithParam<Way> {
 protected:
  CompositeOptions options_ = GetParam().options;
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
  const RankStatistics first = statistics_;
  const auto again = composed<Over>(options_, order, byRank, statistics_);
  const auto inProcess = compositeInProcess<Over>(options_, frame, order, byRank);
  const Traffic& traffic = inProcess.traffic[static_cast<std::size_t>(rankIndex())];
  if (options_.isSharingMemory == compositor().hosts().isSharing()) {
    EXPECT_EQ(first.bytesSent, traffic.bytesSent);
    EXPECT_EQ(first.bytesReceived, traffic.bytesReceived);
    EXPECT_EQ(first.messagesSent, traffic.messagesSent);
    EXPECT_EQ(first.bytesByReference, traffic.bytesByReference);
    EXPECT_EQ(first.bytesPackedAway, traffic.bytesPackedAway);
  }
  if (!world().isRoot()) return;
  const auto areSameBits = [](const Image<Rgba>& a, const Image<Rgba>& b) {
    return std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
  };
  EXPECT_TRUE(areSameBits(*image, inProcess.frame));
  EXPECT_TRUE(areSameBits(*image, *again));
  EXPECT_LE(test::largestDifference(*image, expected<Over>(frame, order, byRank)),
            test::overTolerance(world().size()));
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
    EXPECT_TRUE(std::ranges::all_of(std::as_const(*image).pixels(), Affine::isIdentity));
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
  EXPECT_EQ(statistics_.activePixels, isLast ? 1 : 0);
  // By message: header, an entry, a run, padding and the pixel. Within a host: the pixel.
  const bool isShared = options_.isSharingMemory && compositor().hosts().isSharing();
  EXPECT_EQ(statistics_.messagesSent, sends && !isShared ? 1 : 0);
  if (options_.packing == Packing::kNever) {
    const std::size_t bytes =
        sizeof(Rgba) + (isShared ? 0 : MessageLayout{1, 1, false}.payloadBegin());
    EXPECT_EQ(statistics_.bytesSent, sends ? static_cast<std::int64_t>(bytes) : 0);
  }
  if (world().isRoot()) {
    EXPECT_EQ(image->pixels()[777], (Rgba{0.5f, 0, 0, 0.5f}));
  }
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
      compositor().toRoot<Over>(options_, shuffledRanks(3), mine, drawing, statistics_);
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

// While pixels are swapped and gathered: with `isSpread` all ranks draw everywhere, else each draws
// rows of its own, which nobody combines. Nobody waits for a message that does not come, and the
// frame after is whole.
TEST_P(Composite, MergingFailsOnAnyRank) {
  const ImageSize frame{24, 16 * world().size()};
  const auto order = shuffledRanks(4);
  std::map<std::pair<Work, bool>, int> failures;
  for (const bool isSpread : {true, false}) {
    std::vector<Subimage<Rgba>> byRank;
    for (int rank = 0; rank < world().size(); ++rank) {
      const PixelRect rows = isSpread ? PixelRect{0, 0, frame.width, frame.height}
                                      : PixelRect{0, 16 * rank, frame.width, 16 * (rank + 1)};
      byRank.push_back(
          {frame, rows,
           std::vector<Rgba>(rows.pixels(), {0.1f * static_cast<float>(rank), 0, 0, 0.5f})});
    }
    const auto whole = composed<Failing>(options_, order, byRank, statistics_);
    for (const Work work : {Work::kStore, Work::kLoad, Work::kCombine}) {
      for (int culprit = 0; culprit < world().size(); ++culprit) {
        SCOPED_TRACE(fmt::format("work {}, rank {}", static_cast<int>(work), culprit));
        std::optional<Rank> accused;
        std::optional<Image<Rgba>> image;
        Failing::hasFailed = false;
        if (rankIndex() == culprit) Failing::fails = work;
        try {
          image = composed<Failing>(options_, order, byRank, statistics_);
        } catch (const CollectiveError& e) {
          accused = e.culprit();
        }
        Failing::fails.reset();
        bool hasFailed = Failing::hasFailed;
        broadcastBytes(world(), std::as_writable_bytes(std::span{&hasFailed, 1}), Rank{culprit});
        EXPECT_EQ(accused, hasFailed ? std::optional{Rank{culprit}} : std::nullopt);
        if (!hasFailed && image) {
          EXPECT_TRUE(test::areEqual(*image, *whole));
        }
        failures[{work, isSpread}] += hasFailed ? 1 : 0;
        const auto after = composed<Failing>(options_, order, byRank, statistics_);
        if (after) {
          EXPECT_TRUE(test::areEqual(*after, *whole));
        }
      }
    }
  }
  const int others = world().size() - 1;
  const bool isByMessage = !(options_.isSharingMemory && compositor().hosts().isSharing());
  EXPECT_EQ((failures[{Work::kCombine, false}]), 0);
  EXPECT_GE((failures[{Work::kCombine, true}]), std::min(others, 1));
  // Gathered by message: all but the root store, the root alone loads.
  EXPECT_EQ((failures[{Work::kStore, false}]), isByMessage ? others : 0);
  EXPECT_EQ((failures[{Work::kLoad, false}]), isByMessage ? std::min(others, 1) : 0);
  if (options_.schedule == ScheduleOptions{ScheduleKind::kBinarySwap} &&
      std::has_single_bit(static_cast<unsigned>(world().size())) && others > 0) {
    EXPECT_EQ((failures[{Work::kCombine, true}]), world().size());
    EXPECT_EQ((failures[{Work::kStore, true}]), world().size());  // within a host, too
  }
}

TEST_P(Composite, SubimageThatContradictsItselfIsItsRanksFailure) {
  const int culprit = world().size() - 1;
  Subimage<Rgba> mine{{4, 4}, {0, 0, 2, 2}, std::vector<Rgba>(rankIndex() == culprit ? 3U : 4U)};
  try {
    compositor().toRoot<Over>(options_, shuffledRanks(0), mine, {}, statistics_);
    ADD_FAILURE() << "taken";
  } catch (const CollectiveError& e) {
    EXPECT_EQ(e.culprit(), Rank{culprit});
  }
}

std::string complaint(const CompositeOptions& options, const std::vector<Rank>& order,
                      const Subimage<Rgba>& mine) {
  RankStatistics statistics;
  try {
    compositor().toRoot<Over>(options, order, mine, {}, statistics);
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

TEST_P(Composite, PhasesAreTimed) {
  const auto byRank = test::randomSubimages<Over>({61, 47}, world().size(), 14);
  composed<Over>(options_, shuffledRanks(1), byRank, statistics_);
  EXPECT_GT(statistics_.phases[Phase::kComposite], 0);
  EXPECT_GT(statistics_.phases[Phase::kGather], 0);
  EXPECT_EQ(statistics_.phases[Phase::kDraw], 0);
}

// A frame of another size or pixel type may need new shared memory; what a frame left there must
// not show in the next.
TEST_P(Composite, FramesOfAnySizeAndPixelInTurn) {
  unsigned seed = 100;
  for (const ImageSize frame : {ImageSize{64, 64}, ImageSize{3, 2}, ImageSize{300, 200},
                                ImageSize{300, 200}, ImageSize{1, 1}}) {
    const auto order = shuffledRanks(++seed);
    const auto over = test::randomSubimages<Over>(frame, world().size(), seed);
    const auto affine = test::randomSubimages<Affine>(frame, world().size(), seed + 50);
    const auto image = composed<Over>(options_, order, over, statistics_);
    const auto maps = composed<Affine>(options_, order, affine, statistics_);
    if (!image) continue;
    EXPECT_LE(test::largestDifference(*image, expected<Over>(frame, order, over)),
              test::overTolerance(world().size()));
    EXPECT_TRUE(test::areEqual(*maps, expected<Affine>(frame, order, affine)));
  }
}

// One above the other nobody has pixels where another has some: nothing is composited, and the root
// is sent every pixel of the others once.
TEST_P(Composite, PixelsOfOneRankAloneGoStraightToTheRoot) {
  const int p = world().size();
  const int height = 8 * TileGrid{ImageSize{100, 64 * p}}.tileHeight();
  const ImageSize frame{100, height * p};
  ASSERT_EQ(height % TileGrid{frame}.tileHeight(), 0);
  const Rgba colour{0.25f, 0, 0, 0.5f};
  std::vector<Subimage<Rgba>> byRank;
  for (int i = 0; i < p; ++i) {
    const PixelRect part{0, height * i, 100, height * (i + 1)};
    byRank.push_back({frame, part, std::vector<Rgba>(part.pixels(), colour)});
  }
  const auto image = composed<Over>(options_, shuffledRanks(3), byRank, statistics_);
  const bool isShared = options_.isSharingMemory && compositor().hosts().isSharing();
  EXPECT_EQ(statistics_.messagesSent, world().isRoot() || isShared ? 0 : 1);
  EXPECT_EQ(statistics_.bytesSent, statistics_.bytesToRoot);
  EXPECT_TRUE(compositor().lastPlan().participants.empty());
  if (image) {
    EXPECT_TRUE(
        std::ranges::all_of(image->pixels(), [&](const Rgba& pixel) { return pixel == colour; }));
  }
}

std::vector<Way> ways() {
  const auto way = [](const char* name, std::optional<ScheduleOptions> schedule, bool isSharing,
                      Packing packing) {
    return Way{name, {schedule, std::nullopt, packing, isSharing, Rank{0}}};
  };
  using Kind = ScheduleKind;
  return {way("Auto", std::nullopt, true, Packing::kNever),
          way("BinarySwap", ScheduleOptions{Kind::kBinarySwap}, true, Packing::kNever),
          way("BinarySwapByValue", ScheduleOptions{Kind::kBinarySwap}, false, Packing::kNever),
          way("RadixK", ScheduleOptions{Kind::kRadixK}, false, Packing::kNever),
          way("DirectSend", ScheduleOptions{Kind::kDirectSend}, true, Packing::kNever),
          way("DirectSendByValue", ScheduleOptions{Kind::kDirectSend}, false, Packing::kNever),
          way("DirectSendPacked", ScheduleOptions{Kind::kDirectSend}, false, Packing::kAlways),
          way("SerialGather", ScheduleOptions{Kind::kSerialGather}, true, Packing::kNever)};
}
INSTANTIATE_TEST_SUITE_P(, Composite, testing::ValuesIn(ways()),
                         [](const auto& way) { return way.param.name; });

}  // namespace
}  // namespace burin::compositor
