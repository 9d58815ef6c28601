#include "burin/common/colour.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "burin/common/error.hpp"

namespace burin {
namespace {

TEST(Colour, ReadsLongAndShortForm) {
  EXPECT_EQ(parseColour("#e8dcc0"), (Colour{0xe8, 0xdc, 0xc0}));
  EXPECT_EQ(parseColour("#FFf7E6"), (Colour{0xff, 0xf7, 0xe6}));
  EXPECT_EQ(parseColour("#1af"), (Colour{0x11, 0xaa, 0xff}));
}

TEST(Colour, HexAndParseAreInverse) {
  for (int i = 0; i < 256; ++i) {
    const auto c = static_cast<std::uint8_t>(i);
    const Colour colour{c, static_cast<std::uint8_t>(255 - i), static_cast<std::uint8_t>(i ^ 0x5a)};
    EXPECT_EQ(parseColour(colour.hex()), colour);
  }
}

TEST(Colour, RefusesEverythingElseAndNamesIt) {
  for (const char* text :
       {"", "#", "#12", "#12345", "#1234567", "ffffff", "#gg0000", "#12 456", "red"}) {
    try {
      parseColour(text);
      ADD_FAILURE() << "accepted '" << text << "'";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage);
      EXPECT_THAT(error.what(), testing::HasSubstr(std::string{"'"} + text + "'"));
    }
  }
}

TEST(Srgb, KnownValues) {
  EXPECT_EQ(linearFromSrgb(0), 0);
  EXPECT_EQ(linearFromSrgb(1), 1);
  // ((0.5 + 0.055) / 1.055)^2.4, computed to 16 digits apart from this program; 4 ulp for pow.
  EXPECT_NEAR(linearFromSrgb(0.5), 0.2140411404822325, 1e-15);
  EXPECT_DOUBLE_EQ(linearFromSrgb(0.04), 0.04 / 12.92);
}

TEST(Srgb, InverseAndIncreasing) {
  double last = -1;
  for (int i = 0; i <= 1000; ++i) {
    const double encoded = i / 1000.0;
    const double linear = linearFromSrgb(encoded);
    EXPECT_GT(linear, last);
    last = linear;
    // The standard's two constants meet to 3e-8 only (0.0031308 is rounded); away from the joint
    // both ways are exact but for rounding.
    EXPECT_NEAR(srgbFromLinear(linear), encoded, 1e-7);
  }
}

TEST(Colour, LinearGoesChannelByChannel) {
  const glm::dvec3 linear = Colour{255, 0, 128}.linear();
  EXPECT_EQ(linear.r, 1);
  EXPECT_EQ(linear.g, 0);
  EXPECT_EQ(linear.b, linearFromSrgb(128 / 255.0));
}

}  // namespace
}  // namespace burin
