// quality.max_error draws the same picture on any ranks, with any bricks.

#include <gtest/gtest.h>

#include "host/max_error_scenes.hpp"
#include "support/mpi_test.hpp"

namespace burin::test {
namespace {

using namespace host;

// Which parts are halved depends on their own values alone. Those differ between bricks by the
// texture unit's rounding of coordinates (5e-5 in a pixel, as at fixed steps), which may tip the
// balance for a part. That halves it once more, which changes it by no more than half of what the
// first time did (kinks are first order), so by a sixteenth of the error asked for, and no ray has
// two such parts. Bricks end a ray by themselves, at another sixteenth.
constexpr double tolerance(double asked) {
  return 5e-5 + asked / 16 + asked / 16;
}

TEST(MaxErrorInvariance, DependsNeitherOnRanksNorOnBricks) {
  const Communicator world{MPI_COMM_WORLD};
  const Communicator alone{MPI_COMM_SELF};
  for (const Case& c :
       {Case{"ct-phantom", -400, 900, 0.5, false}, Case{"marschner-lobb", 0.5, 0.52, 0.9, true}}) {
    PreparedScene scene = prepared(c);
    // Gradients are asked for at the parts' middles, up to half a segment outside of the brick.
    scene.scene.layers.front().styles = {defaultSettings(*findStyle("light"))};
    constexpr double kAsked = 1.0 / 128;
    Image<Rgba> one;
    if (world.isRoot()) one = drawn(alone, scene, kAsked, true);
    const Image<Rgba> ranks = drawn(world, scene, kAsked, true);
    const Image<Rgba> bricks = drawn(world, scene, kAsked, true, {.bricks = 8});
    if (!world.isRoot()) continue;
    EXPECT_LE(largestDifference(one, ranks), tolerance(kAsked)) << c.procedural;
    EXPECT_LE(largestDifference(one, bricks), tolerance(kAsked)) << c.procedural;
  }
}

}  // namespace
}  // namespace burin::test
