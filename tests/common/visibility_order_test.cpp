#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "burin/common/brick_tree.hpp"
#include "common/views.hpp"

namespace burin {
namespace {

using test::Axes;
using test::Random;

constexpr ImageSize kOrderImage{64, 64};

BrickTree randomTree(Random& random, Axes axes, glm::ivec3 dims) {
  const VolumeGrid grid = test::makeGrid(random, dims, axes);
  const glm::dvec3 hot = random.vector(0, 20);
  const auto cost = [hot](const IndexBox& box) {  // additive: a density times the volume, per axis
    const glm::dvec3 lo{box.lo};
    const glm::dvec3 hi{box.hi};
    const glm::dvec3 along = hi * (hi + hot) - lo * (lo + hot);
    return along.x * along.y * along.z;
  };
  return BrickTree::build({grid, random.integer(1, 9), random.integer(1, 40), cost, {}});
}

/// Follows random rays through all bricks. Of any two bricks that a ray meets, the one earlier in
/// the order must be left before the other is entered. Returns how many such pairs were met.
int expectOrderAlongRays(const BrickTree& tree, const Camera& camera, Random& random, int rays) {
  const std::vector<BrickId> order = tree.visibilityOrder(camera);
  std::vector<BrickId> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(sorted.size(), tree.brickCount());
  EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end()) << "a brick twice";
  // Depths of a few hundred, divided by direction components as small as 1e-3: rounding stays below
  // 1e-9; a wrong order shows as whole bricks.
  const double rounding = 1e-9 * tree.grid().boundingRadius() *
                          std::max(1.0, glm::length(camera.eyeWorld - tree.grid().centreWorld()) /
                                            tree.grid().boundingRadius());
  int meetings = 0;
  for (int i = 0; i < rays; ++i) {
    const test::Ray ray = test::rayWorld(camera, random.real(0, kOrderImage.width),
                                         random.real(0, kOrderImage.height));
    std::optional<test::Interval> last;
    for (const BrickId brick : order) {
      const auto inside = test::depthsInside(tree.grid(), tree.brickCells(brick), camera, ray);
      if (!inside || inside->end - inside->begin < rounding) continue;
      if (last) {
        EXPECT_LE(last->end, inside->begin + rounding);
      }
      meetings += last ? 1 : 0;
      last = inside;
    }
  }
  return meetings;
}

void expectOwnersInOrder(const BrickTree& tree, const Camera& camera) {
  std::vector<int> owners;
  for (const BrickId brick : tree.visibilityOrder(camera)) owners.push_back(tree.brickOwner(brick));
  owners.erase(std::unique(owners.begin(), owners.end()), owners.end());
  EXPECT_EQ(owners.size(), static_cast<std::size_t>(tree.ownerCount())) << "an owner came twice";
  EXPECT_EQ(owners, tree.ownerVisibilityOrder(camera));
}

TEST(VisibilityOrder, HoldsAlongRandomRays) {
  Random random{30};
  int meetings = 0;
  for (const Axes axes : {Axes::kAligned, Axes::kRotated, Axes::kReflected, Axes::kSheared}) {
    for (const Projection projection : {Projection::kPerspective, Projection::kOrthographic}) {
      for (const double diagonals : {0.0, 0.1, 0.3, 2.0, 1000.0}) {  // first ones: eye inside
        for (int trial = 0; trial < 4; ++trial) {
          const BrickTree tree = randomTree(random, axes, {20, 27, 14});
          const Camera camera = test::randomCamera(random, tree.grid(), projection,
                                                   std::max(diagonals, 1e-6), kOrderImage);
          Camera zoomed = camera;
          if (projection == Projection::kPerspective) zoomed.pixelSize /= std::max(diagonals, 1.0);
          meetings += expectOrderAlongRays(tree, zoomed, random, 60);
          expectOwnersInOrder(tree, camera);
        }
      }
    }
  }
  EXPECT_GT(meetings, 10000) << "too few rays met two bricks to show anything";
}

TEST(VisibilityOrder, EyeInASplitPlane) {
  Random random{31};
  for (const Axes axes : {Axes::kAligned, Axes::kReflected, Axes::kSheared}) {
    for (int trial = 0; trial < 20; ++trial) {
      const BrickTree tree = randomTree(random, axes, {20, 27, 14});
      for (const BrickTree::Node& node : tree.nodes()) {
        if (node.axis < 0) continue;
        glm::dvec3 eye =
            glm::dvec3{node.cells.lo} + glm::dvec3{node.cells.size()} * random.vector(-0.5, 1.5);
        eye[node.axis] = node.plane;
        Camera camera =
            test::randomCamera(random, tree.grid(), Projection::kPerspective, 1, kOrderImage);
        camera.eyeWorld = tree.grid().worldFromIndex(eye);
        expectOwnersInOrder(tree, camera);
        const auto order = tree.visibilityOrder(camera);
        for (int i = 0; i < 20; ++i) {
          const test::Ray ray{camera.eyeWorld, random.direction()};
          double left = 0;
          for (const BrickId brick : order) {
            const auto inside =
                test::depthsInside(tree.grid(), tree.brickCells(brick), camera, ray);
            if (!inside || inside->end - inside->begin < 1e-9) continue;
            EXPECT_GE(inside->begin, left - 1e-9);  // depths below 100: rounding far below this
            left = inside->end;
          }
        }
      }
    }
  }
}

TEST(VisibilityOrder, AxisParallelViewsLieInSplitPlanes) {
  Random random{32};
  int meetings = 0;
  for (const char upAxis : {'y', 'z'}) {
    for (const double azimuth : {0.0, 90.0, 180.0, 270.0}) {
      for (const double elevation : {-90.0, 0.0, 90.0}) {
        const BrickTree tree = randomTree(random, Axes::kAligned, {20, 27, 14});
        const Camera camera =
            orbitCamera({azimuth, elevation, 30, 1, upAxis, Projection::kOrthographic}, tree.grid(),
                        kOrderImage);
        meetings += expectOrderAlongRays(tree, camera, random, 200);
        expectOwnersInOrder(tree, camera);
      }
    }
  }
  EXPECT_GT(meetings, 1000) << "too few rays met two bricks to show anything";
}

TEST(VisibilityOrder, LeftComesFirstInThePlane) {
  VolumeGrid grid;
  grid.dims = {9, 3, 3};
  const BrickTree tree = BrickTree::build({grid, 2, 0, {}, {}});
  ASSERT_EQ(tree.nodes()[0].plane, 4);
  const std::vector<int> leftFirst{0, 1};
  const std::vector<int> rightFirst{1, 0};
  const auto from = [&](double x, Projection projection) {
    return tree.ownerVisibilityOrder(
        lookAtCamera({x, 1, 30}, {4, 1, 1}, {0, 1, 0}, 30, 1, projection, grid, kOrderImage));
  };
  EXPECT_EQ(from(3.999, Projection::kPerspective), leftFirst);
  EXPECT_EQ(from(4, Projection::kPerspective), leftFirst);
  EXPECT_EQ(from(4.001, Projection::kPerspective), rightFirst);
  EXPECT_EQ(from(3.999, Projection::kOrthographic), leftFirst);
  EXPECT_EQ(from(4, Projection::kOrthographic), leftFirst);
  EXPECT_EQ(from(4.001, Projection::kOrthographic), rightFirst);
}

}  // namespace
}  // namespace burin
