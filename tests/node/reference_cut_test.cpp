// Cut surfaces: what light sees where clip planes and the clip box cut.
#include <gtest/gtest.h>

#include "node/reference_fixture.hpp"

namespace burin::test {
namespace {

/// A homogeneous volume, which has no gradients: only a cut gives light a direction. Seen along -z,
/// lit from there, and so opaque that next to nothing is seen of what is a voxel deep.
class ReferenceCut : public testing::Test {
 protected:
  static constexpr double kAmbient = 0.25, kDiffuse = 0.5;

  ReferenceCut() {
    scene.layers[0].styles = {makeStyle("light", {{"ambient", kAmbient}, {"diffuse", kDiffuse}})};
    scene.lights = {{.direction = {0, 0, 1}, .eyeSpace = false}};
  }

  /// Brightness of the middle pixel over the unshaded colour's.
  double brightness() {
    const glm::dvec3 centre = grid.centreWorld();
    const Camera camera =
        makeCamera(Projection::kOrthographic, centre + glm::dvec3{0, 0, 50}, centre, 1, {1, 1});
    const glm::dvec4 pixel = draw(scene, source, camera).front();
    return pixel.g / pixel.a;
  }

  VolumeGrid grid = makeGrid({12, 12, 12});
  ArraySource source = homogeneous(grid);
  Scene scene = makeScene({makeLayer(constantTransfer({255, 255, 255}, 0.9999))}, 0.125);
};

TEST_F(ReferenceCut, FacesTheLightAsItsPlaneDoes) {
  EXPECT_NEAR(brightness(), 1, 1e-12);  // no direction: unshaded
  const double z = grid.centreWorld().z;
  for (const double slope : {0.0, 0.5, 2.0}) {
    // Through the centre; the normal of what is left leans away from the light by its slope.
    const glm::dvec3 normal{slope, 0, -1};
    scene.clip = {{normal, -glm::dot(normal, grid.centreWorld())}};
    const double cosine = 1 / std::sqrt(1 + slope * slope);
    // exp(-9.2 s) of the light is left at depth s along the ray, cosine s from the plane; the cap
    // is whole to one voxel from it.
    EXPECT_NEAR(brightness(), kAmbient + kDiffuse * cosine, std::pow(1e-4, 1 / cosine) + 1e-12)
        << slope;
    scene.clip[0].hasCap = false;
    EXPECT_NEAR(brightness(), 1, 1e-12);
  }
  scene.clip.clear();
  scene.clipBox = ClipBox{grid.origin - 1.0, {grid.origin.x + 20, grid.origin.y + 20, z}};
  EXPECT_NEAR(brightness(), kAmbient + kDiffuse, 1e-4 + 1e-12);
  scene.clipBox->hasCap = false;
  EXPECT_NEAR(brightness(), 1, 1e-12);
}

TEST_F(ReferenceCut, EndsTwoVoxelsFromThePlane) {
  const double z = grid.centreWorld().z;
  scene.clip = {{{0, 0, -1}, z}};
  // A second cut, without a cap, hides the first one's cap but for what reaches so deep.
  const auto seenAt = [&](double depth) {
    scene.clip.resize(1);
    scene.clip.push_back({{0, 0, -1}, z - depth, false});
    return brightness();
  };
  // Shares fall linearly from 1 to 2 voxels; light sees 1 - share unshaded, at the first segment's
  // middle or within two of them further in.
  EXPECT_NEAR(seenAt(1.5), 0.5 + 0.5 * (kAmbient + kDiffuse), 0.25 * 0.125 * 2);
  EXPECT_NEAR(seenAt(2), 1, 1e-12);
}

TEST_F(ReferenceCut, BoxKeepsItsInside) {
  // Through the box along z the chord is what it keeps: 3 of the volume's 11 units.
  scene.layers[0].transferFunction = constantTransfer({255, 255, 255}, 0.1);
  const glm::dvec3 centre = grid.centreWorld();
  const Camera camera =
      makeCamera(Projection::kOrthographic, centre + glm::dvec3{0, 0, 50}, centre, 1, {1, 1});
  scene.clipBox = ClipBox{centre - glm::dvec3{1, 1, 2}, centre + glm::dvec3{1, 1, 1}};
  EXPECT_NEAR(opticalDepth(draw(scene, source, camera).front()), -3 * std::log(0.9), 1e-12);
  scene.clipBox = ClipBox{centre + glm::dvec3{0.5, -1, -2}, centre + glm::dvec3{1, 1, 1}};
  EXPECT_EQ(draw(scene, source, camera).front().a, 0);  // beside the ray
}

}  // namespace
}  // namespace burin::test
