// However pixels lie, a message is never longer than its stated bound.
#include <gtest/gtest.h>

#include "burin/compositor/in_process_executor.hpp"
#include "test_images.hpp"

namespace burin::compositor {
namespace {

/// Header, an entry per tile, four bytes per run, less than an alignment of padding, the pixels.
template <PixelAlgebra A>
std::size_t bound(const SparseImage<typename A::Pixel>& tiles, std::size_t entryBytes) {
  std::size_t bytes = MessageLayout::kHeaderBytes + MessageLayout::kPayloadAlignment - 1;
  for (const auto& tile : tiles) {
    if (tile.empty()) continue;
    bytes += entryBytes + 4 * tile.runs.size() + tile.active * A::kMaxWireBytes;
  }
  return bytes;
}

template <typename A>
class MessageBounds : public testing::Test {
 protected:
  /// A frame in which `isActive(x, y)` tells the active pixels.
  template <typename IsActive>
  void check(ImageSize size, IsActive&& isActive) {
    test::Random random{1};
    Subimage<typename A::Pixel> image{size, {0, 0, size.width, size.height}, {}};
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        image.pixels.push_back(isActive(x, y) ? test::randomPixel(A{}, random) : A::identity());
      }
    }
    const TileGrid grid{size};
    FrameMemory pixels, runs, messages;
    const auto tiles = compress<A>(image, grid, Keep::kCopy, {pixels, runs});
    using Tile = SparseTile<typename A::Pixel>;
    const auto encode = [&](const Transfer& transfer) {
      return encodeTiles<A>(std::span<const Tile>{tiles}, {0, tiles.size()}, transfer, messages);
    };
    const std::size_t plain = encode({}).bytes.size();
    EXPECT_LE(plain, bound<A>(tiles, 8));
    EXPECT_LE(encode({nullptr, true}).bytes.size(), plain);
    // By reference to a host whose memory none of it lies in: longer entries, else the same.
    const std::vector<std::byte> elsewhere(64);
    const SharedSpaces spaces{{std::span{elsewhere}}};
    EXPECT_LE(encode({&spaces, false}).bytes.size(), bound<A>(tiles, 24));
  }
};

using BoundedAlgebras =
    testing::Types<Over, OverHalf, Maximum, Nearest, Silhouette, SilhouetteDepth, FlatRecords<4>,
                   Product<Channel<"beauty", Over>, Channel<"silhouette", Silhouette>>>;
TYPED_TEST_SUITE(MessageBounds, BoundedAlgebras);

TYPED_TEST(MessageBounds, DenseFrames) {
  for (const ImageSize size : {ImageSize{1, 1}, ImageSize{131, 37}, ImageSize{997, 1}}) {
    this->check(size, [](int, int) { return true; });
  }
}

TYPED_TEST(MessageBounds, EverySecondPixelIsTheWorstForRuns) {
  for (const ImageSize size : {ImageSize{131, 37}, ImageSize{997, 1}}) {
    this->check(size, [](int x, int y) { return (x + y) % 2 == 0; });
    this->check(size, [](int x, int) { return x % 3 == 0; });
  }
}

TYPED_TEST(MessageBounds, EmptyFramesAreTheHeader) {
  this->check({131, 37}, [](int, int) { return false; });
}

// A full frame costs next to nothing above its pixels: a run and an entry for each tile.
TEST(MessageBound, OfADenseTileIsItsPixelsAndLittleMore) {
  test::Random random{2};
  const ImageSize size{512, 512};
  auto image = test::randomSubimage<Over>(size, {0, 0, 512, 512}, random);
  for (Rgba& pixel : image.pixels) pixel.a = 1;
  const TileGrid grid{size};
  FrameMemory pixels, runs, messages;
  const auto tiles = compress<Over>(image, grid, Keep::kCopy, {pixels, runs});
  const auto message =
      encodeTiles<Over>(std::span<const SparseTile<Rgba>>{tiles}, {0, tiles.size()}, {}, messages);
  EXPECT_LE(message.bytes.size(), size.pixels() * sizeof(Rgba) + 12 * grid.count() + 64);
}

// Of P full frames each pixel is sent by P - 1 ranks while compositing, and once to the root unless
// the root owns it.
TEST(MessageBound, OfAWholeDenseFrame) {
  const ImageSize size{259, 131};
  for (const int ranks : {2, 3, 5, 7, 8, 13}) {
    std::vector<Subimage<Rgba>> images;
    std::vector<Rank> order;
    for (int i = 0; i < ranks; ++i) {
      images.push_back({size, {0, 0, 259, 131}, {}});
      images.back().pixels.resize(size.pixels(), Rgba{0, 0, 0, 0.5f});
      order.push_back(Rank{i});
    }
    for (const ScheduleKind kind : {ScheduleKind::kBinarySwap, ScheduleKind::kRadixK,
                                    ScheduleKind::kDirectSend, ScheduleKind::kSerialGather}) {
      const CompositeOptions options{ScheduleOptions{kind}, {}, Packing::kNever, false, Rank{0}};
      const auto result = compositeInProcess<Over>(options, size, order, images);
      std::int64_t bytes = 0;
      std::int64_t messages = 0;
      for (const Traffic& traffic : result.traffic) {
        bytes += traffic.bytesSent;
        messages += traffic.messagesSent;
      }
      const auto p = static_cast<std::int64_t>(ranks);
      const auto pixels = static_cast<std::int64_t>(size.pixels() * sizeof(Rgba));
      const auto tiles = static_cast<std::int64_t>(result.plan.grid.count());
      EXPECT_LE(bytes, p * pixels + 12 * p * tiles + 64 * messages) << ranks;
    }
  }
}

}  // namespace
}  // namespace burin::compositor
