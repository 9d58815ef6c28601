#include "burin/compositor/product.hpp"

#include <gtest/gtest.h>

#include "random_pixels.hpp"

namespace burin::compositor {
namespace {

using Picture = Product<Channel<"beauty", Over>, Channel<"lines", Silhouette>,
                        Channel<"other lines", Silhouette>, Channel<"first", Nearest>>;

TEST(Product, EveryChannelIsCombinedByItsOwnAlgebra) {
  test::Random random{1};
  for (int trial = 0; trial < 1000; ++trial) {
    const auto front = test::randomPixel(Picture{}, random);
    const auto back = test::randomPixel(Picture{}, random);
    const auto both = Picture::combine(front, back);
    EXPECT_EQ(Picture::get<"beauty">(both),
              over(Picture::get<"beauty">(front), Picture::get<"beauty">(back)));
    EXPECT_EQ(Picture::get<"lines">(both),
              Silhouette::combine(Picture::get<"lines">(front), Picture::get<"lines">(back)));
    EXPECT_EQ(
        Picture::get<"other lines">(both),
        Silhouette::combine(Picture::get<"other lines">(front), Picture::get<"other lines">(back)));
    EXPECT_EQ(Picture::get<"first">(both),
              Nearest::combine(Picture::get<"first">(front), Picture::get<"first">(back)));
  }
}

TEST(Product, ChannelsAreSetAndListedByName) {
  Picture::Pixel pixel;
  EXPECT_TRUE(Picture::isIdentity(pixel));
  Picture::get<"other lines">(pixel) = Silhouette::slice(SliceSymbol::kContour);
  EXPECT_FALSE(Picture::isIdentity(pixel));
  EXPECT_TRUE(Silhouette::isIdentity(Picture::get<"lines">(pixel)));
  EXPECT_EQ(Picture::kNames,
            (std::array<std::string_view, 4>{"beauty", "lines", "other lines", "first"}));
}

TEST(Product, WireIsTheChannelsOneAfterTheOther) {
  using Two = Product<Channel<"lines", SilhouetteDepth>, Channel<"beauty", OverHalf>>;
  EXPECT_EQ(Two::kMinWireBytes, 9u);
  EXPECT_EQ(Two::kMaxWireBytes, 13u);
  test::Random random{2};
  for (int trial = 0; trial < 1000; ++trial) {
    const auto pixel = test::randomPixel(Two{}, random);
    std::array<std::byte, Two::kMaxWireBytes> together{};
    std::array<std::byte, Two::kMaxWireBytes> apart{};
    std::size_t length = SilhouetteDepth::store(Two::get<"lines">(pixel), apart);
    length += OverHalf::store(Two::get<"beauty">(pixel), std::span{apart}.subspan(length));
    EXPECT_EQ(Two::store(pixel, together), length);
    EXPECT_EQ(together, apart);
  }
}

TEST(Product, DamageInAnyChannelIsDamage) {
  using Two = Product<Channel<"front", Silhouette>, Channel<"back", Silhouette>>;
  Two::Pixel into;
  EXPECT_EQ(Two::load(std::array{std::byte{1}, std::byte{6}}, into), 2u);
  EXPECT_EQ(Two::load(std::array{std::byte{7}, std::byte{1}}, into), 0u);
  EXPECT_EQ(Two::load(std::array{std::byte{1}, std::byte{7}}, into), 0u);
}

// Whole runs are copied only if every channel allows it and nothing lies between them.
static_assert(Product<Channel<"a", Over>, Channel<"b", Nearest>>::kWireIsMemory);
static_assert(!Product<Channel<"a", Over>, Channel<"b", Silhouette>>::kWireIsMemory);
static_assert(PixelAlgebra<Product<Channel<"a", Product<Channel<"b", Over>>>>>);

}  // namespace
}  // namespace burin::compositor
