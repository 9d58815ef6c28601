#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "support/against_reference.hpp"
#include "support/scenes.hpp"

namespace burin::test {

/// Cases that are hard on single precision, with (true) and without pre-integrated classes.
class Stability : public testing::TestWithParam<bool> {
 protected:
  /// "all": with magnitudes over the exact maximum, because bins of the percentile's histogram are
  /// 2^-10 wide and volumes that are alike may fall into neighbouring ones.
  static Scene sceneOf(const std::string& style) {
    Scene scene = sceneWithStyle(style);
    scene.imageSize = {48, 40};
    scene.quality.preintegrated = GetParam();
    if (style == "all") scene.layers[0].styles[0].values[2] = std::string{"maximum"};
    return scene;
  }

  /// How far a smooth volume's picture may be from the truth.
  ///
  /// Middles, no styles: a texture coordinate rounds six times by u = 2^-24 of the texture at most,
  /// so for n voxels a side a position is off by 6nu voxels and a value by v = 6nug + 2u, where the
  /// field changes by g of its range per voxel; here n = 30, g <= 0.1: v <= 1.2e-6. Where
  /// extinction changes by s per unit of value, a chord L of it is off by d = L s v optical depth
  /// and the picture by d exp(-eL), largest at L = 1 / e: s v / (2.7 e) for extinction e.
  /// gentleTransfer- Function: s <= 3.9, e >= 0.3 on that side of it: 6e-6, for roundings all of
  /// one sign.
  ///
  /// Pre-integrated: colours are differences of sums up to S (350) over at least one bin, so a ray
  /// may collect L u S = 1e-3 if all roundings had one sign. They have not; the contract's 1e-4
  /// stands. So it does for styles, whose normals amplify roundings where gradients are weak.
  static double smoothBound(const std::string& style) {
    return style == "plain" && !GetParam() ? 1e-5 : kReferenceBound;
  }

  /// The scene's own camera.
  static Camera cameraOf(const Scene& scene, const node::BrickSource& source) {
    return resolveCamera(scene, {source.info().grid, source.info().anatomical});
  }

  /// Draws; fails where the picture is empty, not finite or further than `bound` from the
  /// reference.
  static Image<Rgba> expectTrue(const std::string& what, const Scene& scene,
                                node::BrickSource& source, const Camera& camera,
                                double bound = kReferenceBound,
                                const node::WorkerOptions& options = {}) {
    ComparedScene compared{scene, source, options};
    return expectTrue(what, compared, camera, bound);
  }

  /// Likewise, for scenes with several views.
  static Image<Rgba> expectTrue(const std::string& what, ComparedScene& compared,
                                const Camera& camera, double bound = kReferenceBound) {
    const DrawnAndTrue both = compared.draw(camera);
    EXPECT_GT(largestAlpha(both.drawn), 0.1) << what << ": an empty picture proves nothing";
    expectNear(what, both.difference(), bound);
    return both.drawn;
  }

  static void expectNear(const std::string& what, const Difference& d, double bound) {
    std::printf("  %s: %.2g (bound %.2g), rms %.2g\n", what.c_str(), d.largest, bound, d.rms);
    EXPECT_TRUE(d.finite) << what;
    EXPECT_LE(d.largest, bound) << what << ", rms " << d.rms;
  }
};

inline std::string classification(const testing::TestParamInfo<bool>& info) {
  return info.param ? "Preintegrated" : "Middle";
}

/// Parallel view along an axis or, backwards, against it; one world unit per pixel. The eye is
/// `shift` (right, up, forward) from where pixel centres and sample planes lie symmetrically around
/// the volume's centre.
inline Camera axisCamera(int axis, bool backwards, const VolumeGrid& grid, ImageSize image,
                         const glm::dvec3& shift = glm::dvec3{0}) {
  Camera camera;
  camera.projection = Projection::kOrthographic;
  camera.image = image;
  camera.forward = camera.up = glm::dvec3{0};
  camera.forward[axis] = backwards ? -1 : 1;
  camera.up[(axis + 1) % 3] = 1;
  camera.right = glm::cross(camera.forward, camera.up);
  camera.eyeWorld = grid.centreWorld() - 100.0 * camera.forward + shift.x * camera.right +
                    shift.y * camera.up + shift.z * camera.forward;
  return camera;
}

}  // namespace burin::test
