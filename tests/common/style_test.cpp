#include "burin/common/style.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace burin {
namespace {

TEST(StyleTable, NamesAreUniqueAndDefaultsLieInTheirRanges) {
  std::set<std::string_view> styles;
  for (const StyleSpec& style : styleTable()) {
    EXPECT_TRUE(styles.insert(style.name).second) << style.name;
    EXPECT_FALSE(style.help.empty()) << style.name;
    EXPECT_GE(style.ghostLayers, style.needsGradient ? 1 : 0) << style.name;
    std::set<std::string_view> parameters;
    for (const ParameterSpec& p : style.parameters) {
      SCOPED_TRACE(std::string{style.name} + "." + std::string{p.name});
      EXPECT_TRUE(parameters.insert(p.name).second);
      EXPECT_FALSE(p.help.empty());
      EXPECT_LT(p.minimum, p.maximum);
      if (const auto* number = std::get_if<double>(&p.defaultValue)) {
        EXPECT_GE(*number, p.minimum);
        EXPECT_LE(*number, p.maximum);
      } else if (const auto* word = std::get_if<std::string>(&p.defaultValue)) {
        EXPECT_THAT(p.choices, testing::Contains(*word));
      } else if (const auto* curve = std::get_if<Curve>(&p.defaultValue)) {
        ASSERT_FALSE(curve->points.empty());
        for (const glm::dvec2& point : curve->points) {
          EXPECT_GE(point.y, p.minimum);
          EXPECT_LE(point.y, p.maximum);
        }
      } else if (const auto* colours = std::get_if<ColourCurve>(&p.defaultValue)) {
        EXPECT_FALSE(colours->points.empty());
      } else if (const auto* direction = std::get_if<glm::dvec3>(&p.defaultValue)) {
        EXPECT_NE(*direction, glm::dvec3{0});
      }
    }
  }
}

TEST(StyleTable, EffectsApplyInTheAgreedOrder) {
  std::vector<std::string_view> names;
  for (const StyleSpec& style : styleTable()) names.push_back(style.name);
  EXPECT_THAT(names, testing::ElementsAre("gradient", "surface", "boundary", "silhouette", "fade",
                                          "light", "tone", "toon", "depth", "laplacian", "halo",
                                          "edges", "specular", "line_surface"));
}

TEST(StyleTable, StylesByPositionSayWhichOne) {
  std::vector<std::string_view> byPosition;
  for (const StyleSpec& style : styleTable()) {
    if (!style.needsPosition) continue;
    byPosition.push_back(style.name);
    const StyleSettings settings = defaultSettings(style);
    EXPECT_EQ(settings.word("along"), "view") << style.name;
    EXPECT_EQ(settings.direction("axis"), (glm::dvec3{0, 0, 1})) << style.name;
    EXPECT_EQ(style.ghostLayers, 0) << style.name;
  }
  EXPECT_THAT(byPosition, testing::ElementsAre("fade", "depth"));
}

TEST(StyleTable, FindsByName) {
  for (const StyleSpec& style : styleTable()) EXPECT_EQ(findStyle(style.name), &style);
  EXPECT_EQ(findStyle("ton"), nullptr);
}

TEST(StyleSettings, DefaultsByName) {
  const StyleSettings tone = defaultSettings(*findStyle("tone"));
  EXPECT_EQ(tone.word("mode"), "map");
  EXPECT_EQ(tone.number("beta"), 0.6);
  EXPECT_EQ(tone.colour("warm"), (Colour{0xff, 0xdc, 0xa8}));
  const StyleSettings surface = defaultSettings(*findStyle("surface"));
  EXPECT_EQ(surface.curve("opacity"), (Curve{{{0.02, 0}, {0.25, 1}}}));
}

TEST(StyleSettings, WrongNameOrKindIsOurMistake) {
  const StyleSettings tone = defaultSettings(*findStyle("tone"));
  EXPECT_THROW(tone.number("strengh"), std::logic_error);
  EXPECT_THROW(tone.number("warm"), std::logic_error);
  EXPECT_THROW(tone.colour("strength"), std::logic_error);
  EXPECT_THROW(tone.curve("mode"), std::logic_error);
}

TEST(Curve, LinearBetweenPointsAndConstantOutside) {
  const Curve curve{{{0, 1}, {0.5, 3}, {1, 0}}};
  EXPECT_EQ(curve.at(-1), 1);
  EXPECT_DOUBLE_EQ(curve.at(0.125), 1.5);
  EXPECT_EQ(curve.at(0.5), 3);
  EXPECT_DOUBLE_EQ(curve.at(0.75), 1.5);
  EXPECT_EQ(curve.at(2), 0);
}

TEST(ColourCurve, LinearLightBetweenPointsAndConstantOutside) {
  const ColourCurve curve{{{-1, {255, 0, 0}}, {0, {0, 0, 255}}, {2, {0, 255, 0}}}};
  EXPECT_EQ(curve.at(-3), (glm::dvec3{1, 0, 0}));
  EXPECT_EQ(curve.at(-0.25), (glm::dvec3{0.25, 0, 0.75}));
  EXPECT_EQ(curve.at(0), (glm::dvec3{0, 0, 1}));
  EXPECT_EQ(curve.at(0.5), (glm::dvec3{0, 0.25, 0.75}));
  EXPECT_EQ(curve.at(9), (glm::dvec3{0, 1, 0}));
}

TEST(StyleHelp, NamesEveryParameterWithItsRangeAndDefault) {
  const std::string help = styleHelp();
  for (const StyleSpec& style : styleTable()) {
    EXPECT_THAT(help, testing::HasSubstr(std::string{style.name}));
    for (const ParameterSpec& p : style.parameters) {
      EXPECT_THAT(help, testing::HasSubstr("  " + std::string{p.name} + " "));
      EXPECT_THAT(help, testing::HasSubstr(std::string{p.help}));
    }
  }
  EXPECT_THAT(help,
              testing::HasSubstr("shininess; large is small and sharp (1 … 200, default 32)"));
  EXPECT_THAT(help, testing::HasSubstr("(map | colors | gooch | ebert, default map)"));
  EXPECT_THAT(help, testing::HasSubstr("(direction, default [0, 0, 1])"));
  EXPECT_THAT(help, testing::HasSubstr("(curve of colours, default [[-1, #"));
  EXPECT_THAT(help, testing::HasSubstr("default #7088c8"));
  EXPECT_THAT(help, testing::HasSubstr("0 … 4, default [[0.02, 0], [0.25, 1]]"));
}

}  // namespace
}  // namespace burin
