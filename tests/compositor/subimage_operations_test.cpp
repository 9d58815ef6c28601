#include "burin/compositor/subimage_operations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "test_images.hpp"

namespace burin::compositor {
namespace {

using testing::HasSubstr;

std::string complaint(const Subimage<Rgba>& image) {
  try {
    checkSubimage(image);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(CheckSubimage, RefusesRectanglesOutsideTheFrameAndWrongCounts) {
  const std::vector<Rgba> six(6);
  EXPECT_EQ(complaint({{4, 4}, {1, 1, 4, 3}, six}), "");
  EXPECT_EQ(complaint({{4, 4}, {}, {}}), "");
  EXPECT_THAT(complaint({{4, 4}, {2, 1, 5, 3}, six}), HasSubstr("[2,5)x[1,3) is not inside 4x4"));
  EXPECT_THAT(complaint({{4, 4}, {-1, 1, 2, 3}, six}), HasSubstr("is not inside"));
  EXPECT_THAT(complaint({{4, 4}, {1, 1, 3, 3}, six}), HasSubstr("4 pixels expected, 6 given"));
  EXPECT_THAT(complaint({{4, 4}, {}, six}), HasSubstr("0 pixels expected"));
}

TEST(Trim, BlankSubimageBecomesEmpty) {
  Subimage<Rgba> image{{9, 9}, {2, 2, 7, 8}, std::vector<Rgba>(30)};
  trim<Over>(image);
  EXPECT_TRUE(image.active.empty());
  EXPECT_TRUE(image.pixels.empty());
}

TEST(Trim, KeepsLightWithoutOpacity) {
  Subimage<Rgba> image{{3, 1}, {0, 0, 3, 1}, {{}, {1, 0, 0, 0}, {}}};
  trim<Over>(image);
  EXPECT_EQ(image.active, (PixelRect{1, 0, 2, 1}));
}

TEST(Trim, FindsTheTightRectangleAndKeepsThePicture) {
  test::Random random{6};
  const ImageSize frame{12, 10};
  for (int trial = 0; trial < 2000; ++trial) {
    auto image = test::randomSubimage<test::Affine>(frame, {1, 2, 11, 9}, random);
    std::ranges::fill(image.pixels, test::Affine::identity());
    PixelRect expected;
    for (int i = test::below(random, 4); i > 0; --i) {
      const int x = 1 + test::below(random, 10);
      const int y = 2 + test::below(random, 7);
      image.pixels[static_cast<std::size_t>((y - 2) * 10 + (x - 1))] = {7, 7};
      expected = boundingRect(expected, {x, y, x + 1, y + 1});
    }
    auto trimmed = image;
    trim<test::Affine>(trimmed);
    ASSERT_EQ(trimmed.active, expected);
    checkSubimage(trimmed);
    ASSERT_TRUE(test::areEqual(test::combineSerially<test::Affine>(frame, {image}),
                               test::combineSerially<test::Affine>(frame, {trimmed})));
  }
}

}  // namespace
}  // namespace burin::compositor
