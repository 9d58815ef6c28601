#include "burin/common/colour_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "burin/common/error.hpp"
#include "burin/common/scene.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

using testing::HasSubstr;

glm::dvec3 codes(double r, double g, double b) {
  return glm::dvec3{r, g, b} / 255.0;
}

/// Largest difference of a channel, in 255ths.
double difference(const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 d = 255.0 * glm::abs(a - b);
  return std::max({d.r, d.g, d.b});
}

TEST(BlendColours, DivergingIsMorelandsPublishedTable) {
  // "Diverging Color Maps for Scientific Visualization", the table of 33 bytes: every fourth row.
  const glm::dvec3 blue = codes(59, 76, 192), red = codes(180, 4, 38);
  const glm::dvec3 table[] = {codes(59, 76, 192),   codes(98, 130, 234),  codes(141, 176, 254),
                              codes(184, 208, 249), codes(221, 221, 221), codes(245, 196, 173),
                              codes(244, 154, 123), codes(222, 96, 77),   codes(180, 4, 38)};
  for (int i = 0; i <= 8; ++i) {
    // The table's ends are not bytes: half a code there, half a code for rounding its entries.
    EXPECT_LE(
        difference(blendColours(ColourSpace::kDiverging, false, blue, red, i / 8.0), table[i]), 1.5)
        << i;
  }
}

TEST(BlendColours, DivergingKeepsAHueThatNoWhiteParts) {
  // Blue to white: Moreland's magnitude and saturation go linearly, computed here from the
  // published formulas once more, for t = 1/2 between L*a*b* colours given directly.
  const glm::dvec3 white{1, 1, 1}, blue = codes(59, 76, 192);
  const glm::dvec3 middle = blendColours(ColourSpace::kDiverging, false, blue, white, 0.5);
  EXPECT_GT(middle.b, middle.g);
  EXPECT_GT(middle.g, blue.g);
  EXPECT_LT(difference(blendColours(ColourSpace::kDiverging, false, white, blue, 0.5), middle),
            1e-9);
}

TEST(BlendColours, LabGoesByLightness) {
  // Black to white is grey; L* = 50 is 18.42 % of the light, sRGB 0.4663 (CIE 15, IEC 61966-2-1).
  const glm::dvec3 grey = blendColours(ColourSpace::kLab, false, {0, 0, 0}, {1, 1, 1}, 0.5);
  // Four digits of the matrices leave a thousandth.
  EXPECT_NEAR(grey.r, 0.4663, 1e-3);
  EXPECT_NEAR(grey.g, 0.4663, 1e-3);
  EXPECT_NEAR(grey.b, 0.4663, 1e-3);
}

TEST(BlendColours, HsvGoesAroundTheCircle) {
  const glm::dvec3 red{1, 0, 0}, green{0, 1, 0}, magenta{1, 0, 1};
  EXPECT_LT(difference(blendColours(ColourSpace::kHsv, false, red, green, 0.5), {1, 1, 0}), 1e-9);
  // 0° to 300°: by 150°, or the short way by 330°.
  EXPECT_LT(difference(blendColours(ColourSpace::kHsv, false, red, magenta, 0.5), {0, 1, 0.5}),
            1e-9);
  EXPECT_LT(difference(blendColours(ColourSpace::kHsv, true, red, magenta, 0.5), {1, 0, 0.5}),
            1e-9);
}

TEST(BlendColours, EndsStayInEverySpace) {
  const glm::dvec3 a = codes(10, 200, 90), b = codes(240, 30, 130);
  for (const ColourSpace space :
       {ColourSpace::kRgb, ColourSpace::kHsv, ColourSpace::kLab, ColourSpace::kDiverging}) {
    // The matrices to and from XYZ are inverse to four digits.
    EXPECT_LT(difference(blendColours(space, false, a, b, 0), a), 0.1);
    EXPECT_LT(difference(blendColours(space, false, a, b, 1), b), 0.1);
  }
}

TEST(NodeWeight, IsWhatVtkDocuments) {
  EXPECT_EQ(nodeWeight(0.3, 0.5, 0), 0.3);          // linear
  EXPECT_DOUBLE_EQ(nodeWeight(0.2, 0.2, 0), 0.5);   // the midpoint
  EXPECT_DOUBLE_EQ(nodeWeight(0.6, 0.2, 0), 0.75);  // linear on either side of it
  EXPECT_EQ(nodeWeight(0.49, 0.5, 1), 0);           // a step
  EXPECT_EQ(nodeWeight(0.51, 0.5, 1), 1);
  for (const double sharpness : {0.2, 0.5, 0.9}) {
    EXPECT_NEAR(nodeWeight(0.5, 0.5, sharpness), 0.5, 1e-12);
    EXPECT_NEAR(nodeWeight(0.2, 0.5, sharpness), 1 - nodeWeight(0.8, 0.5, sharpness), 1e-12);
    EXPECT_LT(nodeWeight(0.25, 0.5, sharpness), 0.25);  // flatter at the ends
  }
}

void expectAsNear(const ColourMap& map, const TransferFunction& function) {
  const double first = function.points.front().value, last = function.points.back().value;
  for (int i = 0; i <= 2000; ++i) {
    const double x = first + (last - first) * (i + 0.37) / 2001;
    const Classified found = function.classify(x, 1);
    const glm::dvec3 shown{srgbFromLinear(found.colour.r), srgbFromLinear(found.colour.g),
                           srgbFromLinear(found.colour.b)};
    EXPECT_LE(difference(shown, map.colourAt(x)), kColourMapCodes) << x;
    // Opacities of 1 are cut to kLargestOpacity.
    EXPECT_NEAR(-std::expm1(-found.extinction), map.opacityAt(x),
                kColourMapOpacity + (1 - kLargestOpacity))
        << x;
  }
}

ColourMap map(ColourSpace space) {
  ColourMap made;
  made.space = space;
  made.colours = {{-1, codes(59, 76, 192)}, {0.25, codes(10, 60, 20)}, {3, codes(180, 4, 38)}};
  made.opacities = {{-1, 0}, {0, 0.8, 0.3, 0.4}, {1, 0.1, 0.5, 1}, {2, 1, 0.7, 0}, {3, 0.5}};
  return made;
}

TEST(TransferFunctionFrom, StaysAsNearAsItSays) {
  for (const ColourSpace space : {ColourSpace::kRgb, ColourSpace::kHsv, ColourSpace::kLab,
                                  ColourSpace::kDiverging, ColourSpace::kStep}) {
    const TransferFunction function = transferFunctionFrom(map(space));
    EXPECT_LE(function.points.size(), 500u);
    expectAsNear(map(space), function);
  }
}

TEST(TransferFunctionFrom, StepsStaySteps) {
  ColourMap steps;
  steps.colours = {{0, {0, 0, 0}}, {1, {1, 0, 0}}, {1, {0, 1, 0}}, {2, {0, 1, 0}}};
  steps.opacities = {{0, 0.25, 0.5, 1}, {2, 0.75}};
  const TransferFunction function = transferFunctionFrom(steps);
  EXPECT_EQ(function.classify(1, 1).colour, (glm::dvec3{0, 1, 0}));
  EXPECT_NEAR(function.classify(1 - 1e-9, 1).colour.r, 1, 1e-6);
  EXPECT_NEAR(function.classify(0.999, 1).extinction, extinctionFromOpacity(0.25, 1), 1e-12);
  EXPECT_NEAR(function.classify(1.001, 1).extinction, extinctionFromOpacity(0.75, 1), 1e-12);
}

TEST(TransferFunctionFrom, ARangeMovesTheValues) {
  const TransferFunction function =
      transferFunctionFrom(map(ColourSpace::kLab), glm::dvec2{300, 700});
  EXPECT_EQ(function.points.front().value, 300);
  EXPECT_EQ(function.points.back().value, 700);
  EXPECT_EQ(function.points.front().colour, (Colour{59, 76, 192}));
}

TEST(ReadColourMap, ParaviewsJson) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("maps.json", R"([
    { "Name": "first", "ColorSpace": "Lab", "RGBPoints": [0, 0, 0, 0, 10, 1, 0.5, 0.25] },
    { "Name": "second", "ColorSpace": "HSV", "NanColor": [1, 1, 0], "Creator": "x",
      "RGBPoints": [5, 1, 0, 0, -5, 0, 0, 1], "Points": [-5, 0, 0.5, 0, 5, 1, 0.25, 0.5] } ])");
  const ColourMap first = readColourMap(file);
  EXPECT_EQ(first.name, "first");
  EXPECT_EQ(first.space, ColourSpace::kLab);
  EXPECT_EQ(first.colours[1].colour, (glm::dvec3{1, 0.5, 0.25}));
  EXPECT_EQ(first.opacityAt(2.5), 0.25);  // none given: a ramp
  const ColourMap second = readColourMap(file, "second");
  EXPECT_EQ(second.colours[0].x, -5);  // sorted
  EXPECT_EQ(second.opacities[1].midpoint, 0.25);
}

TEST(ReadColourMap, SlicersPresets) {
  const test::TemporaryFolder folder;
  // The example in 3D Slicer's documentation of the format.
  const std::string text = folder.write(
      "ct.vp",
      "1\n1\n0.9\n0.1\n0.2\n10\n"
      "14 -3024 0 -86.9767 0 45.3791 0.169643 139.919 0.589286 347.907 0.607143 1224.16 0.607143 "
      "3071 0.616071\n4 0 1 255 1\n"
      "28 -3024 0 0 0 -86.9767 0 0.25098 1 45.3791 1 0 0 139.919 1 0.894893 0.894893 347.907 1 1 "
      "0.25098 1224.16 1 1 1 3071 0.827451 0.658824 1\n");
  const ColourMap ct = readColourMap(text);
  EXPECT_EQ(ct.colours.size(), 7u);
  EXPECT_NEAR(ct.opacityAt((45.3791 + 139.919) / 2), (0.169643 + 0.589286) / 2, 1e-12);
  EXPECT_NEAR(ct.colourAt((45.3791 + 139.919) / 2).g, 0.894893 / 2, 1e-12);
  EXPECT_FALSE(ct.hasGradientOpacity);
  expectAsNear(ct, transferFunctionFrom(ct));

  const std::string json = folder.write("mr.vp.json", R"({ "volumeProperties": [ { "components": [ {
    "scalarOpacityUnitDistance": 0.5,
    "rgbTransferFunction": { "type": "colorTransferFunction", "points": [
      { "x": 0, "color": [0, 0, 0] }, { "x": 100, "color": [1, 1, 1], "midpoint": 0.5 } ] },
    "scalarOpacity": { "points": [ { "x": 0, "y": 0 }, { "x": 50, "y": 1, "sharpness": 0.25 },
                                   { "x": 100, "y": 0 } ] },
    "gradientOpacity": { "points": [ { "x": 0, "y": 0 }, { "x": 20, "y": 1 } ] } } ] } ] })");
  const ColourMap mr = readColourMap(json);
  EXPECT_EQ(mr.unitLength, 0.5);
  EXPECT_EQ(mr.opacities[1].sharpness, 0.25);
  EXPECT_TRUE(mr.hasGradientOpacity);
  testing::internal::CaptureStderr();
  readColourMap(text);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  testing::internal::CaptureStderr();
  readColourMap(json);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::AllOf(HasSubstr(json), HasSubstr("opacity by gradient")));
  EXPECT_EQ(transferFunctionFrom(mr).opacityUnitLength, 0.5);
}

TEST(ParaviewJson, ComesBack) {
  TransferFunction function;
  function.points = {{-1000, {0, 0, 0}, 0},
                     {200, {181, 114, 76}, 0.05},
                     {200, {20, 20, 240}, 0.6},
                     {1200, {255, 255, 255}, 1}};
  const test::TemporaryFolder folder;
  const ColourMap back = readColourMap(folder.write("out.json", paraviewJson(function, "mine")));
  EXPECT_EQ(back.name, "mine");
  const TransferFunction again = transferFunctionFrom(back);
  for (int i = 0; i <= 2000; ++i) {
    const double x = -1000 + 2200 * (i + 0.37) / 2001;
    const Classified a = function.classify(x, 1), b = again.classify(x, 1);
    const glm::dvec3 first{srgbFromLinear(a.colour.r), srgbFromLinear(a.colour.g),
                           srgbFromLinear(a.colour.b)};
    EXPECT_LE(difference(first, back.colourAt(x)), kColourMapCodes) << x;
    const glm::dvec3 second{srgbFromLinear(b.colour.r), srgbFromLinear(b.colour.g),
                            srgbFromLinear(b.colour.b)};
    EXPECT_LE(difference(first, second), 2 * kColourMapCodes) << x;
    EXPECT_NEAR(-std::expm1(-a.extinction), -std::expm1(-b.extinction), 2 * kColourMapOpacity) << x;
  }
  EXPECT_EQ(again.classify(200, 1).colour, (Colour{20, 20, 240}.linear()));
}

std::string messageOf(const std::string& file, std::string_view map = {}) {
  try {
    readColourMap(file, map);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    return error.what();
  }
  return "accepted";
}

TEST(ReadColourMap, MistakesAreNamedWithTheirPlace) {
  const test::TemporaryFolder folder;
  const auto json = [&](std::string_view text) { return messageOf(folder.write("m.json", text)); };
  EXPECT_THAT(messageOf(folder / "none.json"), HasSubstr("none.json: cannot read the colour map"));
  EXPECT_THAT(json("{}"), HasSubstr("neither a colour map of ParaView"));
  EXPECT_THAT(json(R"({ "schema_version": 1, "layers": [] })"), HasSubstr("colormap --paraview"));
  EXPECT_THAT(json(R"([{ "RGBPoints": [0, 1, 1] }])"), HasSubstr("[0].RGBPoints: expected a list"));
  EXPECT_THAT(json(R"([{ "RGBPoints": [0, 1, 1, 1, 2] }])"), HasSubstr("4 numbers for each point"));
  EXPECT_THAT(json(R"([{ "RGBPoints": [0, 1, 1, "x"] }])"), HasSubstr("expected a number"));
  EXPECT_THAT(json(R"([{ "ColorSpace": "Lap", "RGBPoints": [0, 1, 1, 1] }])"),
              HasSubstr("did you mean 'Lab'?"));
  EXPECT_THAT(json(R"([{ "IndexedColors": [1, 0, 0] }])"), HasSubstr("categories"));
  EXPECT_THAT(json(R"([{ "RGBPoints": [0, 1, 1, 1], "Points": [0, 1, 2, 0] }])"),
              HasSubstr("midpoint 2"));
  EXPECT_THAT(
      messageOf(folder.write("m.json", R"([{ "Name": "a", "RGBPoints": [0,0,0,0] }])"), "b"),
      HasSubstr("no map is called 'b'"));
  EXPECT_THAT(messageOf(folder.write("m.vp", "1\n1\n")), HasSubstr("expected at least 9"));
  EXPECT_THAT(messageOf(folder.write("m.vp", "1\n1\n1\n1\n1\n1\n3 0 0 1\n2 0 1\n4 0 1 1 1\n")),
              HasSubstr("m.vp:7: expected how many numbers follow"));
}

TEST(SceneWithAColourMap, TakesItsPoints) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("cool.json", R"([{ "ColorSpace": "Diverging",
    "RGBPoints": [0, 0.2314, 0.298, 0.7529, 1, 0.7059, 0.0157, 0.149] }])");
  const std::string text = R"({ "schema_version": 1, "layers": [{ "transfer_function":
    { "file": "cool.json", "range": [300, 700], "opacity_unit_length": 2 } }] })";
  const Scene scene = parseScene(text, folder / "scene.json");
  TransferFunction expected = transferFunctionFrom(readColourMap(file), glm::dvec2{300, 700});
  expected.opacityUnitLength = 2;
  EXPECT_EQ(scene.layers[0].transferFunction, expected);
  EXPECT_EQ(parseScene(writeScene(scene), "elsewhere.json"), scene);
  const auto overrides =
      std::vector<std::string>{"layers.0.transfer_function.opacity_unit_length=3"};
  EXPECT_EQ(parseScene(text, folder / "scene.json", overrides)
                .layers[0]
                .transferFunction.opacityUnitLength,
            3);
}

}  // namespace
}  // namespace burin
