// The reference with a largest error instead of a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "node/reference_fixture.hpp"

namespace burin::test {
namespace {

constexpr double kAsked = 1e-4;
const Colour kColour{255, 128, 0};

Scene convergedScene(TransferFunction transfer) {
  Scene scene = makeScene({makeLayer(std::move(transfer))}, 1);
  scene.quality.maxError = kAsked;
  return scene;
}

/// Full opacity in a window of values, nothing outside: steps at both ends.
TransferFunction window(double from, double to, double opacity) {
  return {.points = {{from, kColour, 0},
                     {from, kColour, opacity},
                     {to, kColour, opacity},
                     {to, kColour, 0}},
          .opacityUnitLength = 1.0};
}

// The value is x·y in one cell: along the line x + y = 1 it is t (1 - t), which only just reaches
// into the window. No fixed step finds the ends; their distance is known.
TEST(ReferenceConverged, GrazesAShellInClosedForm) {
  const VolumeGrid grid{
      .dims = {2, 2, 2}, .origin = {0, 0, 0}, .spacing = glm::dvec3{1}, .direction = glm::dmat3{1}};
  ArraySource source{grid, [](glm::ivec3 at) { return static_cast<float>(at.x * at.y); }};
  const double height = 0.25 - 1e-4;
  const Scene scene = convergedScene(window(height, 1, 0.99));
  const Camera camera =
      makeCamera(Projection::kOrthographic, {-1, 2, 0.5}, {0.5, 0.5, 0.5}, 1e-9, {1, 1});
  const double inside = 2 * std::sqrt(1e-4) * std::sqrt(2.0);
  const double alpha = 1 - std::pow(0.01, inside);
  EXPECT_NEAR(draw(scene, source, camera).front().a, alpha, kAsked);
  EXPECT_GT(alpha, 0.1);
}

// Rough values, so that cells differ and the value turns within them.
ArraySource rough(const VolumeGrid& grid) {
  return {grid, [](glm::ivec3 at) {
            const auto hash =
                static_cast<std::uint32_t>(at.x * 7919 + at.y * 104729 + at.z * 611953);
            return static_cast<float>((hash * 2654435761u) >> 8) * 0x1p-24f;
          }};
}

// Fixed steps come ever closer to it. They converge with the step at least to the first order: the
// difference of two that are a factor of two apart bounds what is left.
TEST(ReferenceConverged, IsWhereFixedStepsGo) {
  const VolumeGrid grid = makeGrid({6, 7, 5}, {1, 0.8, 1.3});
  const TransferFunction spikes{.points = {{0.3, kColour, 0},
                                           {0.35, kColour, 0.7},
                                           {0.4, {0, 64, 255}, 0},
                                           {0.6, {0, 64, 255}, 0},
                                           {0.9, {64, 255, 64}, 0.5}},
                                .opacityUnitLength = 1.0};
  const StyleSettings light = makeStyle("light");
  for (const bool lit : {false, true}) {
    Scene scene = convergedScene(spikes);
    if (lit) scene.layers.front().styles = {light};
    const glm::dvec3 centre = grid.origin + grid.spacing * glm::dvec3{grid.dims - 1} / 2.0;
    const Camera camera =
        makeCamera(Projection::kPerspective, centre + glm::dvec3{9, 7, 14}, centre, 0.06, {8, 8});
    ArraySource source = rough(grid);
    const auto converged = draw(scene, source, camera);
    ASSERT_GT(largestOpacity(converged), 0.3);
    scene.quality.maxError.reset();
    std::array<std::vector<glm::dvec4>, 2> stepped;
    for (const int i : {0, 1}) {
      scene.quality.stepVoxels = i == 0 ? 1.0 / 256 : 1.0 / 512;
      stepped[static_cast<std::size_t>(i)] = draw(scene, source, camera);
    }
    EXPECT_LE(largestDifference(converged, stepped[1]),
              kAsked + 2 * largestDifference(stepped[0], stepped[1]))
        << (lit ? "lit" : "plain");
    EXPECT_LE(largestDifference(stepped[0], stepped[1]), 10 * kAsked);
  }
}

}  // namespace
}  // namespace burin::test
