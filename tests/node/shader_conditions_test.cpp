#include "shader_conditions.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "burin/common/error.hpp"

namespace burin::node {
namespace {

/// Those of `lines` that are in the program, one letter each: all but the directives.
std::string kept(const std::vector<std::string_view>& lines) {
  ShaderConditions conditions;
  std::string text;
  for (const std::string_view line : lines)
    if (conditions.keeps(line) && !line.starts_with('#')) text += line;
  EXPECT_TRUE(conditions.isClosed());
  return text;
}

TEST(ShaderConditions, OneOfTheBranchesIsKept) {
  const std::vector<std::string_view> branches{"#ifdef A", "a",     "#elif defined(B)", "b",
                                               "#else",    "other", "#endif",           "."};
  const auto with = [&](std::vector<std::string_view> defines) {
    defines.insert(defines.end(), branches.begin(), branches.end());
    return kept(defines);
  };
  EXPECT_EQ(with({}), "other.");
  EXPECT_EQ(with({"#define A"}), "a.");
  EXPECT_EQ(with({"#define B 3"}), "b.");
  EXPECT_EQ(with({"#define B 3", "#define A"}), "a.");
  EXPECT_EQ(with({"#define AB"}), "other.") << "another name";
}

TEST(ShaderConditions, InnerOnesDependOnOuterOnes) {
  for (const bool outer : {false, true})
    for (const bool inner : {false, true}) {
      std::vector<std::string_view> lines{outer ? "#define A" : "",
                                          inner ? "#define B" : "",
                                          "#ifdef A",
                                          "#ifdef B",
                                          "ab",
                                          "#else",
                                          "a",
                                          "#define C",
                                          "#endif",
                                          "#endif",
                                          "#ifdef C",
                                          "c",
                                          "#endif"};
      EXPECT_EQ(kept(lines), !outer ? "" : inner ? "ab" : "ac") << outer << inner;
    }
}

TEST(ShaderConditions, ExpressionsAreAllOrAny) {
  for (const bool a : {false, true})
    for (const bool b : {false, true}) {
      const std::vector<std::string_view> lines{a ? "#define A" : "",
                                                b ? "#define B" : "",
                                                "#if defined(A) && defined(B)",
                                                "all",
                                                "#endif",
                                                "#if defined(A) || defined(B)",
                                                "any",
                                                "#endif"};
      EXPECT_EQ(kept(lines), std::string{a && b ? "all" : ""} + (a || b ? "any" : ""));
    }
}

TEST(ShaderConditions, WhatIsNotUnderstoodIsNotPassedOver) {
  const auto fails = [](const std::vector<std::string_view>& lines) {
    ShaderConditions conditions;
    for (const std::string_view line : lines) conditions.keeps(line);
    return conditions.isClosed();
  };
  EXPECT_ANY_THROW(fails({"#if PLANES > 0"}));
  EXPECT_ANY_THROW(fails({"#if defined(A) && defined(B) || defined(C)"}));
  EXPECT_ANY_THROW(fails({"#if !defined(A)"}));
  EXPECT_ANY_THROW(fails({"#ifndef A"}));
  EXPECT_ANY_THROW(fails({"#undef A"}));
  EXPECT_ANY_THROW(fails({"#else"}));
  EXPECT_ANY_THROW(fails({"#endif"}));
  EXPECT_FALSE(fails({"#ifdef A"}));
}

}  // namespace
}  // namespace burin::node
