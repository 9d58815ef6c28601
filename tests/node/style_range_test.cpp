// Every style with its parameters at the ends of their ranges, and every pair of styles together.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/against_reference.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

// Bounds of brick_invariance_test.cpp.
constexpr double kLargestOfRange = 5e-5;
constexpr double kRmsOfRange = 2e-6;

/// A parameter at one end of its range; words go through all their choices.
ParameterValue atEnd(const ParameterSpec& parameter, bool upper, std::size_t round) {
  struct {
    const ParameterSpec& parameter;
    bool upper;
    std::size_t round;
    double end() const { return upper ? parameter.maximum : parameter.minimum; }
    Colour colour() const { return upper ? Colour{255, 255, 255} : Colour{0, 0, 0}; }

    ParameterValue operator()(double) const { return end(); }
    ParameterValue operator()(const Colour&) const { return colour(); }
    ParameterValue operator()(const std::string&) const {
      return std::string{parameter.choices[round % parameter.choices.size()]};
    }
    ParameterValue operator()(const Curve&) const { return Curve{{{0.3, end()}}}; }
    ParameterValue operator()(const ColourCurve&) const { return ColourCurve{{{0.3, colour()}}}; }
    ParameterValue operator()(const glm::dvec3&) const {
      return upper ? glm::dvec3{1e9, -3e9, 2e9} : glm::dvec3{0, 0, -1e-9};
    }
  } pick{parameter, upper, round};
  return std::visit(pick, parameter.defaultValue);
}

/// As many as the parameter with most words has.
std::size_t mostChoices(const StyleSpec& style) {
  std::size_t most = 1;
  for (const ParameterSpec& parameter : style.parameters)
    most = std::max(most, parameter.choices.size());
  return most;
}

Scene smallScene(Scene scene) {
  scene.imageSize = {36, 28};
  scene.camera = {.azimuthDeg = 40, .elevationDeg = 25};
  scene.lights = {{.direction = {0.2, 0.5, 0.8}, .colour = {255, 230, 200}},
                  {.direction = {-1, 0.2, 0.3}, .intensity = 0.5}};
  return scene;
}

// The relative error of e^8, silhouette's largest exponent, is twice that of e^4, its default;
// every other style keeps kReferenceBound at both ends.
constexpr double kSilhouetteBound = 2 * kReferenceBound;

/// The numbers of bricks that are compared are above 1, as a single one has a program of its own:
/// the same program is compiled once.
class StyleRange : public testing::TestWithParam<std::string> {};

TEST_P(StyleRange, EndsAgreeWithTheReferenceOnAnyBricks) {
  ArraySource source = smoothVolume(gridOf({26, 22, 24}, {1, 1.2, 0.8}));
  const StyleSpec& spec = *findStyle(GetParam());
  for (std::size_t round = 0; round < mostChoices(spec); ++round)
    for (const bool upper : {false, true}) {
      Scene scene = smallScene(sceneWithStyle(spec.hasSnippet ? GetParam() : "light"));
      if (!spec.hasSnippet) scene.layers[0].styles.push_back(defaultSettings(spec));
      for (StyleSettings& settings : scene.layers[0].styles)
        if (settings.name == spec.name)
          for (std::size_t i = 0; i < spec.parameters.size(); ++i)
            settings.values[i] = atEnd(spec.parameters[i], upper, round + i);
      scene = resolved(scene, source);
      const Camera camera = resolveCamera(scene, {source.info().grid, false});
      const DrawnAndTrue few = drawWithReference(scene, source, camera, {.bricks = 2});
      SCOPED_TRACE(testing::Message() << "round " << round << (upper ? ", upper" : ", lower"));
      EXPECT_TRUE(few.difference().finite);
      EXPECT_LE(few.difference().largest,
                spec.name == "silhouette" ? kSilhouetteBound : kReferenceBound);
      const Difference d = difference(few.drawn, drawAlone(scene, source, camera, {.bricks = 5}));
      EXPECT_LE(d.largest, kLargestOfRange);
    }
}

std::vector<std::string> allStyles() {
  std::vector<std::string> names;
  for (const StyleSpec& style : styleTable()) names.emplace_back(style.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Styles, StyleRange, testing::ValuesIn(allStyles()),
                         [](const auto& style) { return style.param; });

TEST(StylePairs, AgreeWithTheReferenceOnAnyBricks) {
  ArraySource source = smoothVolume(gridOf({26, 22, 24}, {1, 1.2, 0.8}));
  for (unsigned set = 0; set < kStyleSets; ++set) {
    const Scene scene = resolved(smallScene(sceneWithStyleSet(set)), source);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    const DrawnAndTrue few = drawWithReference(scene, source, camera, {.bricks = 2});
    EXPECT_LE(few.difference().largest, kReferenceBound) << set;
    const Difference d = difference(few.drawn, drawAlone(scene, source, camera, {.bricks = 5}));
    EXPECT_LE(d.largest, kLargestOfRange) << set;
    EXPECT_LE(d.rms, kRmsOfRange) << set;
  }
}

TEST(StylePairs, SkippingChangesNothingBitForBit) {
  ArraySource source = smoothVolume(gridOf({26, 22, 24}, {1, 1.2, 0.8}));
  const Communicator self{MPI_COMM_SELF};
  for (unsigned set = 0; set < kStyleSets; ++set) {
    Scene scene = smallScene(sceneWithStyleSet(set));
    scene.layers[0].transferFunction.points = {
        {0.55, {90, 180, 250}, 0}, {0.6, {250, 180, 90}, 0.6}, {0.65, {9, 250, 20}, 0}};
    if (!scene.layers[0].lineOpacity.empty())
      scene.layers[0].lineOpacity = {{0.3, 0}, {0.35, 0.5}, {0.4, 0}};
    scene.quality.preintegrated = set % 3 != 0;
    scene = resolved(scene, source);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    RankStatistics on, off;
    const auto draw = [&](bool skip, RankStatistics& statistics) {
      return drawAlone(scene, source, camera, {.bricks = 2, .skip = skip, .countSamples = true},
                       &statistics);
    };
    const Image<Rgba> skipped = draw(true, on);
    EXPECT_TRUE(std::ranges::equal(skipped.pixels(), draw(false, off).pixels())) << set;
    EXPECT_EQ(on.samplesShaded, off.samplesShaded) << set;
    // Halos reach a macrocell further: in a volume of six, everywhere (halo_test.cpp).
    if (haloReach(scene) == 0) {
      EXPECT_LT(on.samplesVisited, off.samplesVisited) << set;
    }
    EXPECT_GT(largestAlpha(skipped), 0.01) << set;
  }
}

}  // namespace
}  // namespace burin::test
