#include "burin/host/material_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "burin/host/default_scene.hpp"
#include "coarse_look.hpp"
#include "support/array_source.hpp"
#include "support/mpi_test.hpp"

namespace burin::host {
namespace {

using test::ArraySource;
using test::world;

VolumeGrid cube(int side) {
  VolumeGrid grid;
  grid.dims = glm::ivec3{side};
  return grid;
}

struct Surveyed {
  node::VolumeSurvey survey;
  MaterialProfile profile;
};

Surveyed surveyed(ArraySource source) {
  Surveyed result;
  result.survey = node::surveyVolume(world(), source, {});
  result.profile = profileMaterials(world(), source, result.survey);
  return result;
}

/// 0 outside a ball, `value` inside, with a blurred boundary some voxels wide.
float ball(glm::ivec3 p, glm::dvec3 centre, double radius, double value) {
  const double distance = glm::length(glm::dvec3{p} - centre) - radius;
  return static_cast<float>(value / (1 + std::exp(distance)));
}

TEST(MaterialProfile, ARampHasOneGradientEverywhere) {
  // f = 2x + y over 17³ voxels: the range is 48, |∇f| = √5 per voxel but at the faces, where a
  // neighbour is missing.
  const auto [survey, profile] = surveyed(
      ArraySource{cube(17), [](glm::ivec3 p) { return static_cast<float>(2 * p.x + p.y); }});
  const double steps = std::round(std::sqrt(5.0) / 48 * kGradientSteps);
  EXPECT_EQ(profile.histogram.total(), 17 * 17 * 17);
  EXPECT_EQ(profile.magnitudeCounts[static_cast<std::size_t>(steps)], 15 * 15 * 17);
  const std::size_t middle = profile.histogram.binOf(24);
  EXPECT_NEAR(profile.steepness(middle, 2), steps, 0.1 * steps);
}

TEST(MaterialProfile, SpacingCountsInGradients) {
  VolumeGrid grid = cube(9);
  grid.spacing = {1, 1, 4};
  const auto [survey, profile] =
      surveyed(ArraySource{grid, [](glm::ivec3 p) { return static_cast<float>(p.z); }});
  // 8 values over 8 voxels of 4: an eighth of the range per voxel, a quarter of that per unit.
  EXPECT_EQ(profile.magnitudeCounts[static_cast<std::size_t>(kGradientSteps / 32)], 7 * 81);
}

TEST(MaterialProfile, AFewWildVoxelsDoNotStretchTheBins) {
  const auto [survey, profile] = surveyed(ArraySource{cube(64), [](glm::ivec3 p) {
                                                        if (p == glm::ivec3{20, 30, 40})
                                                          return 1e9f;
                                                        return ball(p, glm::dvec3{32}, 20, 100);
                                                      }});
  EXPECT_LT(profile.histogram.edge(profile.histogram.counts.size()), 101);
  EXPECT_GT(profile.histogram.edge(profile.histogram.counts.size()), 90);
}

TEST(MaterialProfile, LooksAtSomeRowsOfALargeVolume) {
  // 17³ voxels are 289 rows; of each third of each third slice 36. Their gradients are those of
  // neighbours, not of voxels three apart: 2 per voxel of a range of 32, 1 at the two ends.
  ArraySource source{cube(17), [](glm::ivec3 p) { return static_cast<float>(2 * p.x); }};
  const auto survey = node::surveyVolume(world(), source, {});
  const MaterialProfile profile = profileMaterials(world(), source, survey, 36 * 17);
  EXPECT_EQ(profile.histogram.total(), 36 * 17);
  EXPECT_EQ(profile.magnitudeCounts[static_cast<std::size_t>(kGradientSteps / 16)], 36 * 15);
  EXPECT_EQ(profile.magnitudeCounts[static_cast<std::size_t>(kGradientSteps / 32)], 36 * 2);
}

TEST(MaterialProfile, SkipsWhatIsNotFinite) {
  const auto [survey, profile] = surveyed(
      ArraySource{cube(8), [](glm::ivec3 p) { return p.x == 3 ? NAN : static_cast<float>(p.y); }});
  // Neither the NaN voxels nor their neighbours have a gradient.
  EXPECT_EQ(profile.histogram.total(), 5 * 64);
}

Scene defaultSceneOf(ArraySource source) {
  const VolumeGrid grid = source.info().grid;
  const auto [survey, profile] = surveyed(std::move(source));
  VolumeChoice choice;
  choice.file = "ball.nrrd";
  return makeDefaultScene(choice, {grid, false}, profile, survey.blocks);
}

TEST(DefaultSceneOfAVolume, PartsTheBackgroundHalfway) {
  const Scene scene = defaultSceneOf(
      ArraySource{cube(48), [](glm::ivec3 p) { return ball(p, glm::dvec3{24}, 15, 100); }});
  const auto& points = scene.layers[0].transferFunction.points;
  EXPECT_EQ(points.front().opacity, 0);
  // The logistic profile is steepest at its middle, but within 9 % of that over its middle third,
  // by which central differences may differ from direction to direction.
  EXPECT_NEAR(points.front().value, 50, 17);
}

TEST(DefaultSceneOfAVolume, ADenserCoreIsSeenThroughWhatIsAround) {
  const Scene scene = defaultSceneOf(ArraySource{cube(48), [](glm::ivec3 p) {
                                                   return ball(p, glm::dvec3{24}, 18, 100) +
                                                          ball(p, glm::dvec3{24}, 8, 200);
                                                 }});
  const TransferFunction& function = scene.layers[0].transferFunction;
  const double length = *function.opacityUnitLength;
  EXPECT_EQ(function.classify(20, length).extinction, 0);
  const double flesh = function.classify(100, length).extinction;
  EXPECT_GT(flesh, 0);
  EXPECT_LT(36 * flesh, 1) << "what is around the core hides it";
  EXPECT_GT(16 * function.classify(300, length).extinction, 3) << "the core is translucent";
}

TEST(DefaultSceneOfAVolume, ASkinIsSeenAndLeavesMostOfWhatItSurrounds) {
  for (const double core : {4.0, 8.0}) {
    ArraySource source{cube(48), [&](glm::ivec3 p) {
                         return ball(p, glm::dvec3{24}, 18, 100) +
                                ball(p, glm::dvec3{24}, core, 200);
                       }};
    const auto [survey, profile] = surveyed(source);
    VolumeFacts facts;
    facts.grid = source.info().grid;
    VolumeChoice choice;
    choice.file = "ball.nrrd";
    const Scene scene = makeDefaultScene(choice, facts, profile, survey.blocks);
    const TransferFunction& function = scene.layers[0].transferFunction;
    ASSERT_EQ(function.points.size(), 6u) << core;
    const CoarseLook look{facts.grid, survey.blocks, function, function.points[4].value,
                          resolveCamera(scene, facts).forward};
    // Opacities are multiplied at points and interpolated between them, extinctions counted: of a
    // line from 0 to 0.2 the mean of the latter is 3 % higher. What is hidden, 0.4, is as much off;
    // the factor is found within 2^(1/32).
    constexpr double kOff = 0.4 * (0.03 + 0.022);
    const Visibility seen = look.withSkin(1);
    EXPECT_GT(seen.core, 0.6 - kOff) << core;
    EXPECT_TRUE(seen.skin > 0.3 - kOff || seen.core < 0.6 + kOff) << core;
  }
}

TEST(DefaultSceneOfAVolume, LooksCloserAtSmallThings) {
  const auto zoomOf = [](double radius) {
    return defaultSceneOf(
               ArraySource{cube(48),
                           [=](glm::ivec3 p) { return ball(p, glm::dvec3{24}, radius, 100); }})
        .camera.zoom;
  };
  EXPECT_GT(zoomOf(6), 1.5 * zoomOf(18));
}

TEST(DefaultSceneOfAVolume, StandsUprightWhatIsLeftRightSymmetric) {
  // An ellipsoid and a nose: symmetric in x alone.
  const auto head = [](glm::ivec3 p) {
    const glm::dvec3 q = (glm::dvec3{p} - 23.5) / glm::dvec3{0.7, 0.9, 1.1};
    return static_cast<float>(100 / (1 + std::exp(glm::length(q) - 16))) +
           ball(p, {23.5, 3, 16}, 7, 100) + ball(p, {23.5, 40, 40}, 7, 100);
  };
  EXPECT_EQ(defaultSceneOf(ArraySource{cube(48), head}).camera.upAxis, "z");
  // The same lying on its side.
  const auto turned = [&](glm::ivec3 p) { return head({p.y, p.x, p.z}); };
  EXPECT_EQ(defaultSceneOf(ArraySource{cube(48), turned}).camera.upAxis, "y");
}

TEST(DefaultSceneOfAVolume, SlicedScansStandUpright) {
  VolumeGrid grid = cube(24);
  const auto value = [](glm::ivec3 p) { return ball(p, glm::dvec3{12}, 8, 100); };
  EXPECT_EQ(defaultSceneOf(ArraySource{grid, value}).camera.upAxis, "y");
  grid.spacing = {1, 1, 1.5};
  EXPECT_EQ(defaultSceneOf(ArraySource{grid, value}).camera.upAxis, "z");
}

}  // namespace
}  // namespace burin::host
