#include "contact_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "burin/common/error.hpp"
#include "burin/host/text.hpp"

namespace burin::host {
namespace {

int inked(const InkMask& mask) {
  return static_cast<int>(std::ranges::count_if(mask.coverage, [](auto c) { return c > 0; }));
}

TEST(TextMask, HoldsItsLetters) {
  const InkMask one = textMask("Skull", 20);
  const InkMask two = textMask("Skull Skull", 20);
  EXPECT_GT(inked(one), 50);
  EXPECT_GE(inked(two), 2 * inked(one) - 8);  // letters may begin on other fractions of a pixel
  EXPECT_GT(two.width, 2 * one.width - 8);
  EXPECT_EQ(one.height, textHeight(20));
  EXPECT_EQ(inked(textMask("", 20)), 0);
  // Nothing is cut off: the border is free of ink, also below the base line and above capitals.
  const InkMask tall = textMask("ÄgjÅ|", 20);
  for (int x = 0; x < tall.width; ++x) {
    EXPECT_EQ(tall.at(x, 0), 0);
    EXPECT_EQ(tall.at(x, tall.height - 1), 0);
  }
}

DisplayPicture flat(ImageSize size, int channels, std::uint8_t value) {
  DisplayPicture picture;
  picture.size = size;
  picture.channels = channels;
  picture.bytes.assign(size.pixels() * static_cast<std::size_t>(channels), value);
  return picture;
}

TEST(DrawInk, BlendsByCoverage) {
  DisplayPicture picture = flat({3, 2}, 3, 200);
  InkMask mask{2, 1};
  mask.at(0, 0) = 255;
  mask.at(1, 0) = 51;  // a fifth
  drawInk(picture, mask, 1, 1, {100, 0, 50});
  const std::vector<std::uint8_t> lower(picture.bytes.begin() + 9, picture.bytes.end());
  EXPECT_EQ(lower, (std::vector<std::uint8_t>{200, 200, 200, 100, 0, 50, 180, 160, 170}));
  EXPECT_TRUE(std::all_of(picture.bytes.begin(), picture.bytes.begin() + 9,
                          [](auto byte) { return byte == 200; }));
}

TEST(DrawInk, OnNothingIsTheInkItself) {
  DisplayPicture picture = flat({1, 1}, 4, 0);
  InkMask mask{1, 1};
  mask.at(0, 0) = 51;
  drawInk(picture, mask, 0, 0, {100, 0, 50});
  EXPECT_EQ(picture.bytes, (std::vector<std::uint8_t>{100, 0, 50, 51}));
}

TEST(DrawInk, LeavesOutWhatIsOutside) {
  DisplayPicture picture = flat({2, 2}, 3, 9);
  InkMask mask{4, 4};
  std::ranges::fill(mask.coverage, std::uint8_t{255});
  drawInk(picture, mask, -3, -3, {1, 1, 1});
  drawInk(picture, mask, 5, 0, {1, 1, 1});
  EXPECT_EQ(picture.bytes, (std::vector<std::uint8_t>{1, 1, 1, 9, 9, 9, 9, 9, 9, 9, 9, 9}));
}

TEST(ContactSheet, PlacesPanelsInRows) {
  const ImageSize panel{20, 10};
  ContactSheet sheet{layOutSheet(panel, 5, 3)};
  const int width = sheet.picture().size.width;
  const int height = sheet.picture().size.height;
  EXPECT_EQ(width, 4 + 3 * 24);
  for (int i = 0; i < 5; ++i)
    sheet.place(i, flat(panel, 3, static_cast<std::uint8_t>(10 + i)),
                "a name that is longer than its panel");
  const auto at = [&](int x, int y) {
    return sheet.picture().bytes[static_cast<std::size_t>(3 * (y * width + x))];
  };
  const int rowHeight = (height - 4) / 2;
  for (int i = 0; i < 5; ++i) {
    const int x = 4 + i % 3 * 24, y = 4 + i / 3 * rowHeight;
    for (const auto& [dx, dy] : {std::pair{0, 0}, {19, 0}, {0, 9}, {19, 9}})
      EXPECT_EQ(at(x + dx, y + dy), 10 + i);
    // Labels stay below their panels.
    for (int dy = 0; dy < rowHeight; ++dy) {
      EXPECT_EQ(at(x - 1, y + dy), 255);
      EXPECT_EQ(at(x + 20, y + dy), 255);
    }
  }
  EXPECT_THROW(layOutSheet({8000, 8000}, 9, 3), Error);
}

/// The darkest red in rows [top, top + rows) of the sheet.
int darkestIn(const ContactSheet& sheet, int top, int rows) {
  const auto width = 3 * static_cast<std::ptrdiff_t>(sheet.picture().size.width);
  const auto first = sheet.picture().bytes.begin() + top * width;
  return *std::min_element(first, first + rows * width);
}

TEST(ContactSheet, BreaksLabelsBetweenWords) {
  const ImageSize panel{90, 10};
  constexpr int kTop = 4 + 10;  // of the first line
  const auto labelled = [&](int lines, const std::string& label) {
    ContactSheet sheet{layOutSheet(panel, 1, 1, lines)};
    sheet.place(0, flat(panel, 3, 255), label);
    return sheet;
  };
  const int line = textMask("x", 9).height;
  EXPECT_EQ(labelled(3, "").picture().size.height - labelled(1, "").picture().size.height,
            2 * line);
  const auto lineIsUsed = [&](const ContactSheet& sheet, int index) {
    return darkestIn(sheet, kTop + index * line, line) < 128;
  };
  const ContactSheet two = labelled(3, "one or two words here");
  EXPECT_TRUE(lineIsUsed(two, 0));
  EXPECT_TRUE(lineIsUsed(two, 1));
  EXPECT_FALSE(lineIsUsed(two, 2));
  const ContactSheet one = labelled(3, "one word");
  EXPECT_TRUE(lineIsUsed(one, 0));
  EXPECT_FALSE(lineIsUsed(one, 1));
  // More than all lines hold is cut off at the panel's sides.
  const ContactSheet many =
      labelled(2, "a label of far more words than two lines of text can hold");
  EXPECT_TRUE(lineIsUsed(many, 1));
  EXPECT_EQ(darkestIn(many, kTop + 2 * line, 4), 255);
}

TEST(ContactSheet, IsAboutSquare) {
  EXPECT_EQ(squareColumns(1), 1);
  EXPECT_EQ(squareColumns(12), 4);
  EXPECT_EQ(squareColumns(16), 4);
  EXPECT_EQ(squareColumns(17), 5);
}

}  // namespace
}  // namespace burin::host
