// Some rows of the covering array over MPI, on as many ranks as there are.
#include <gtest/gtest.h>

#include "burin/compositor/compositor.hpp"
#include "covering_frames.hpp"
#include "support/mpi_test.hpp"

namespace burin::compositor {
namespace {

using burin::test::world;
using test::Drawn;
using test::FrameRow;
using test::PixelType;
using test::Transfers;

/// Kept over frames, as programs do.
Compositor& compositor() {
  static Compositor instance{world()};
  return instance;
}

template <PixelAlgebra A>
void expectSerialCombination(const FrameRow& row) {
  const auto mine = test::drawnBy<A>(row, static_cast<int>(world().rank()));
  RankStatistics statistics;
  const auto frame = compositor().toRoot<A>(row.options(), row.order(), mine, {}, statistics);
  ASSERT_EQ(frame.has_value(), world().rank() == row.root());
  if (frame) {
    EXPECT_TRUE(test::isSerialCombination<A>(row, *frame));
  }
  std::int64_t bytes[] = {statistics.bytesSent, statistics.bytesReceived};
  allReduce(world(), std::span{bytes}, MPI_SUM);
  if (row.options().isSharingMemory && compositor().hosts().isSharing()) {
    EXPECT_GE(bytes[0], bytes[1]);  // what is put into the root's frame is not received
  } else {
    EXPECT_EQ(bytes[0], bytes[1]);
  }
}

void expectSerialCombination(FrameRow row) {
  row.ranks = world().size();
  test::withAlgebra(row.pixel,
                    [&](auto algebra) { expectSerialCombination<decltype(algebra)>(row); });
}

/// `ranks` is not looked at.
class CoveringArray : public testing::TestWithParam<FrameRow> {};

TEST_P(CoveringArray, EqualsTheSerialCombination) {
  expectSerialCombination(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Mpi, CoveringArray,
    testing::ValuesIn(test::coveringRows({{1}, {{1, 1}, {997, 1}, {509, 503}}, 1e9})),
    [](const auto& row) { return test::nameOf(row.param); });

TEST(LargeFrames, EqualTheSerialCombination) {
  for (const PixelType pixel : {PixelType::kOver, PixelType::kSilhouette}) {
    expectSerialCombination(
        {pixel, std::nullopt, Transfers::kByReference, 1, {2048, 2048}, Drawn::kHalf, 1});
  }
}

// What a rank drew beforehand may lie in memory of its own or be copied to the canvas: the same
// bits come of both.
TEST(PreRendered, FromTheHeapAndFromTheCanvas) {
  for (const Transfers transfers : {Transfers::kByValue, Transfers::kByReference}) {
    FrameRow row{PixelType::kOver, std::nullopt, transfers, world().size(), {509, 503}};
    for (const Drawn drawn : {Drawn::kHundredth, Drawn::kHalf, Drawn::kAll}) {
      row.drawn = drawn;
      const auto mine = test::drawnBy<Over>(row, static_cast<int>(world().rank()));
      RankStatistics statistics;
      const auto fromHeap =
          compositor().toRoot<Over>(row.options(), row.order(), mine, {}, statistics);
      Image<Rgba> kept{row.size};
      if (fromHeap) std::ranges::copy(fromHeap->pixels(), kept.pixels().begin());
      const auto canvas = compositor().canvas<Rgba>(row.size, mine.pixels.size());
      std::ranges::copy(mine.pixels, canvas.begin());
      const auto fromCanvas = compositor().toRoot<Over>(
          row.options(), row.order(), {row.size, mine.active, canvas}, {}, statistics);
      EXPECT_TRUE(std::ranges::equal(canvas, mine.pixels)) << "what was drawn has been changed";
      if (!fromCanvas) continue;
      EXPECT_TRUE(std::ranges::equal(fromCanvas->pixels(), std::as_const(kept).pixels()));
      EXPECT_TRUE(test::isSerialCombination<Over>(row, *fromCanvas));
    }
  }
}

}  // namespace
}  // namespace burin::compositor
