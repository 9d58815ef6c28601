#include "raw_name.hpp"

#include <gtest/gtest.h>

namespace burin::node {
namespace {

TEST(RawName, ReadsDimsAndType) {
  const auto name = parseRawName("csafe_heptane_302x301x300_uint8.raw");
  ASSERT_TRUE(name.has_value());
  EXPECT_EQ(name->dims, glm::ivec3(302, 301, 300));
  EXPECT_EQ(name->type, "uint8");
  EXPECT_EQ(parseRawName("a_1x2x3_float32.raw.gz")->type, "float32");
}

TEST(RawName, OtherNamesSayNothing) {
  for (const char* name :
       {"", "a.raw", "a_uint8.raw", "a_1x2_uint8.raw", "a_1x2x3x4_uint8.raw", "a_1x2x_uint8.raw",
        "a_x2x3_uint8.raw", "a_0x2x3_uint8.raw", "a_-1x2x3_uint8.raw", "a_1x2x3_uint8",
        "a_1x2x3_.raw", "a_1x2x3 _uint8.raw", "_uint8.raw", "a_99999999999x2x3_uint8.raw"}) {
    EXPECT_FALSE(parseRawName(name).has_value()) << name;
  }
}

TEST(RawName, TypesHaveOneName) {
  EXPECT_EQ(canonicalTypeName("uint8"), "u8");
  EXPECT_EQ(canonicalTypeName("int16"), "i16");
  EXPECT_EQ(canonicalTypeName("uint16"), "u16");
  EXPECT_EQ(canonicalTypeName("float32"), "f32");
  EXPECT_EQ(canonicalTypeName("f32"), "f32");
  EXPECT_EQ(canonicalTypeName("float64"), "f64");
  EXPECT_EQ(canonicalTypeName("int8"), "i8");
  EXPECT_EQ(canonicalTypeName("uint32"), "u32");
  EXPECT_FALSE(canonicalTypeName("float16").has_value());
}

}  // namespace
}  // namespace burin::node
