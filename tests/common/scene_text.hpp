#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "burin/common/error.hpp"
#include "burin/common/scene.hpp"

namespace burin::test {

/// What parseScene says about a text; "" if it accepts it.
inline std::string complaint(const std::string& text,
                             const std::vector<std::string>& overrides = {}) {
  try {
    parseScene(text, "s.json", overrides);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
    return error.what();
  }
  return "";
}

inline constexpr const char* kLayers =
    R"("layers": [{ "transfer_function": { "points": [{ "value": 1, "color": "#fff", "opacity": 1 }] } }])";

/// A scene whose second line is `key`.
inline std::string with(const std::string& key) {
  return "{ \"schema_version\": 1, " + std::string{kLayers} + ",\n" + key + " }";
}

}  // namespace burin::test
