#include "burin/common/error.hpp"

#include <gtest/gtest.h>

#include <string>

#include "burin/common/log.hpp"

namespace burin {
namespace {

template <typename Exception, typename Work>
std::string logicErrorOf(Work work) {
  try {
    work();
  } catch (const Exception& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Fail, CarriesCodeAndMessage) {
  try {
    fail(ExitCode::kVolume, "{}: {} bytes, expected {}", "a.raw", 7, 8);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kVolume);
    EXPECT_STREQ(error.what(), "a.raw: 7 bytes, expected 8");
    return;
  }
  FAIL() << "nothing was thrown";
}

TEST(Check, NamesPlaceExpressionAndValues) {
  const int three = 3;
  const std::string equal = logicErrorOf<std::logic_error>([&] { BURIN_CHECK_EQ(three + 1, 5); });
  EXPECT_NE(equal.find("error_test.cpp:"), std::string::npos) << equal;
  EXPECT_NE(equal.find("three + 1 == 5"), std::string::npos) << equal;
  EXPECT_NE(equal.find("4 and 5"), std::string::npos) << equal;
  const std::string plain = logicErrorOf<std::logic_error>([&] { BURIN_CHECK(three > 4); });
  EXPECT_NE(plain.find("three > 4"), std::string::npos) << plain;
  EXPECT_NO_THROW(BURIN_CHECK_EQ(three, 3));
  EXPECT_NO_THROW(BURIN_CHECK(three < 4));
}

TEST(Log, NotesAreQuietedWarningsAreNot) {
  testing::internal::CaptureStderr();
  note("one {}", 1);
  setQuiet(true);
  note("two");
  warn("three");
  setQuiet(false);
  note("four");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "burin: one 1\nburin: warning: three\nburin: four\n");
}

}  // namespace
}  // namespace burin
