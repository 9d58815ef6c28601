// Feature halos lie just outside of what a layer shows, as seen by the eye.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

constexpr double kBall = 12;   // voxels to where the ball's values are 1/2
constexpr double kRadius = 2;  // of the halo
constexpr double kReach = 3;   // how far from the ball it may show: radius and half of it, or 1

/// A ball with a surface two voxels wide, seen in parallel at one voxel per pixel.
struct Ball {
  ArraySource source{gridOf({40, 40, 40}), [](glm::ivec3 i) {
                       const double r = glm::distance(glm::dvec3{i}, glm::dvec3{19.5});
                       return static_cast<float>(std::clamp(0.5 + (kBall - r) / 2, 0.0, 1.0));
                     }};
  Scene scene;

  Ball() {
    scene = sceneWithStyle("halo");
    scene.imageSize = {48, 48};
    scene.camera = {.azimuthDeg = 20,
                    .elevationDeg = 35,
                    .zoom = 2 * source.info().grid.boundingRadius() / 48,
                    .projection = Projection::kOrthographic};
    scene.layers[0].transferFunction = {{{0.5, {255, 255, 255}, 0}, {0.7, {255, 255, 255}, 0.8}},
                                        {}};
    scene.layers[0].styles[0].values[0] = kRadius;
  }

  Image<Rgba> draw(const node::WorkerOptions& options = {}, RankStatistics* statistics = nullptr) {
    const Scene ready = resolved(scene, source);
    return drawAlone(ready, source, resolveCamera(ready, {source.info().grid, false}), options,
                     statistics);
  }
};

/// Smallest and largest opacity, and brightest colour, of pixels that far from the middle.
struct Ring {
  float faintest = 1, densest = 0, brightest = 0;

  Ring(const Image<Rgba>& image, double from, double to) {
    for (int y = 0; y < image.size().height; ++y)
      for (int x = 0; x < image.size().width; ++x) {
        const double r = std::hypot(x + 0.5 - 24, y + 0.5 - 24);
        if (r < from || r > to) continue;
        const Rgba& pixel = image.at(x, y);
        faintest = std::min(faintest, pixel.a);
        densest = std::max(densest, pixel.a);
        brightest = std::max(brightest, pixel.r);
      }
  }
};

TEST(Halo, LiesJustOutsideOfWhatIsSeen) {
  Ball ball;
  const Image<Rgba> with = ball.draw();
  ball.scene.layers[0].styles.clear();
  const Image<Rgba> without = ball.draw();
  // Around the outline: opaque and dark where nothing was, on all sides alike.
  EXPECT_EQ(Ring(without, kBall + 0.2, 24).densest, 0);
  const Ring rim{with, kBall + 1.5, kBall + 2.2};
  EXPECT_GT(rim.faintest, 0.8);
  EXPECT_LT(rim.densest, 1.25f * rim.faintest);
  EXPECT_EQ(rim.brightest, 0);
  // Beyond its reach: nothing at all.
  EXPECT_EQ(Ring(with, kBall + kReach + 0.1, 48).densest, 0);
  // In front of the ball's middle, which the eye sees face-on: hardly anything.
  for (int y = 21; y < 27; ++y)
    for (int x = 21; x < 27; ++x) EXPECT_NEAR(with.at(x, y).r, without.at(x, y).r, 0.01);
}

TEST(Halo, SkippingLeavesIt) {
  Ball ball;
  RankStatistics on, off;
  const Image<Rgba> skipped = ball.draw({.bricks = 3, .countSamples = true}, &on);
  const Image<Rgba> visited = ball.draw({.bricks = 3, .skip = false, .countSamples = true}, &off);
  EXPECT_TRUE(std::ranges::equal(skipped.pixels(), visited.pixels()));
  EXPECT_EQ(on.samplesShaded, off.samplesShaded);
  EXPECT_LT(on.samplesVisited, off.samplesVisited);
}

TEST(Halo, IsOfWhatItsLayerShows) {
  Ball ball;
  ball.scene.layers[0].transferFunction = {{{1.5, {9, 9, 9}, 0}, {2, {9, 9, 9}, 1}}, {}};
  EXPECT_EQ(largestAlpha(ball.draw()), 0);
}

}  // namespace
}  // namespace burin::test
