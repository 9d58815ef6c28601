// Extreme geometry: grids, eyes and rays.

#include <cmath>
#include <map>

#include "stability_fixture.hpp"

namespace burin::test {
namespace {

using StableViews = Stability;

TEST_P(StableViews, SpacingsOfAnyScale) {
  for (const std::string style : {"plain", "all"}) {
    Image<Rgba> unscaled;
    for (const int exponent : {0, -6, 6}) {
      ArraySource source = smoothVolume(gridOf({30, 26, 28}, glm::dvec3{std::pow(10.0, exponent)}));
      const Scene scene = resolved(sceneOf(style), source);
      const std::string name = style + " spacing 1e" + std::to_string(exponent);
      const Image<Rgba> image =
          expectTrue(name, scene, source, cameraOf(scene, source), smoothBound(style));
      if (exponent == 0) unscaled = image;
      // The truth is the same and both are that close to it.
      expectNear(name + " against 1", difference(image, unscaled), 2 * smoothBound(style));
    }
  }
}

TEST_P(StableViews, Anisotropy) {
  // Positions are in voxels whatever their spacing, so a chord of 400 units has values no worse
  // than smoothBound's, and a fifth of the extinction (s and e alike) leaves their quotient as it
  // is.
  for (const std::string style : {"plain", "all"})
    for (int axis = 0; axis < 3; ++axis) {
      glm::ivec3 dims{24};
      dims[axis] = 5;
      glm::dvec3 spacing{1};
      spacing[axis] = 100;
      ArraySource source = smoothVolume(gridOf(dims, spacing));
      Scene scene = sceneOf(style);
      scene.layers[0].transferFunction = gentleTransferFunction(0.2);
      scene = resolved(scene, source);
      expectTrue(style + " thick along " + std::to_string(axis), scene, source,
                 cameraOf(scene, source), smoothBound(style));
    }
}

TEST_P(StableViews, RaysAlongFacesEdgesAndSplitPlanes) {
  // Dims and picture even: pixel centres are on voxel planes, where the volume's faces and splits
  // are. Sample planes are on them as well: segments' ends at step 1/2, middles at step 1.
  ArraySource source = smoothVolume(gridOf({20, 20, 20}));
  for (const std::string style : {"plain", "all"})
    for (const double step : {0.5, 1.0}) {
      Scene scene = sceneOf(style);
      scene.imageSize = {24, 24};
      scene.quality.stepVoxels = step;
      scene = resolved(scene, source);
      ComparedScene compared{scene, source};
      const Communicator self{MPI_COMM_SELF};
      std::map<int, node::Worker> cuts;
      for (const int bricks : {2, 5, 8})
        cuts.try_emplace(bricks, self, scene, source, node::WorkerOptions{.bricks = bricks});
      for (const int axis : {0, 1, 2})
        for (const bool backwards : {false, true}) {
          const Camera camera = axisCamera(axis, backwards, source.info().grid, scene.imageSize);
          const std::string name = style + " along axis " + (backwards ? "-" : "") +
                                   std::to_string(axis) + " step " + std::to_string(step);
          const Image<Rgba> one = expectTrue(name, compared, camera, smoothBound(style));
          for (const int corner : {2, 21})
            EXPECT_GT(one.at(corner, corner).a, 0) << name << ": edges belong to the volume";
          for (const int outside : {1, 22}) EXPECT_EQ(one.at(outside, 12).a, 0) << name;
          for (auto& [bricks, worker] : cuts) {
            // The project's own bound for any partition.
            RankStatistics statistics;
            const Image<Rgba> cut = drawFrame(worker, scene, camera, statistics);
            expectNear(name + ", " + std::to_string(bricks) + " bricks", difference(cut, one),
                       5e-5);
          }
        }
    }
}

TEST_P(StableViews, OneVoxelThick) {
  const TransferFunction function{{{0, {30, 60, 200}, 0.3}, {1, {240, 200, 40}, 0.7}}, {}};
  for (const std::string style : {"plain", "all"})
    for (const glm::ivec3 dims : {glm::ivec3{1, 20, 20}, glm::ivec3{20, 1, 20},
                                  glm::ivec3{20, 20, 1}, glm::ivec3{1, 1, 20}, glm::ivec3{1}}) {
      ArraySource source{gridOf(dims), [](glm::ivec3 i) {
                           return static_cast<float>(smoothField(glm::dvec3{i} + 3.0));
                         }};
      Scene scene = sceneOf(style);
      scene.layers[0].transferFunction = function;
      for (StyleSettings& s : scene.layers[0].styles)
        if (s.name == "surface") s.values[0] = Curve{{{0, 0.7}, {1, 1}}};
      scene = resolved(scene, source);
      const std::string name = style + " " + std::to_string(dims.x) + "x" + std::to_string(dims.y) +
                               "x" + std::to_string(dims.z);
      // smoothBound's s / e is smaller here: 1.3 / 0.36.
      ComparedScene whole{scene, source};
      ComparedScene cut{scene, source, {.bricks = 3}};
      expectTrue(name, whole, cameraOf(scene, source), smoothBound(style));
      expectTrue(name + ", 3 bricks", cut, cameraOf(scene, source), smoothBound(style));
      for (const int axis : {0, 1, 2}) {
        Camera camera = axisCamera(axis, false, source.info().grid, scene.imageSize);
        camera.pixelSize = 0.3;  // several rays through one voxel, none along a face
        expectTrue(name + " along axis " + std::to_string(axis), whole, camera, smoothBound(style));
      }
    }
}

TEST_P(StableViews, FieldsOfViewAndFarEyes) {
  // Lattice and rays are set up in double around the volume's centre: as exact as any other view.
  ArraySource source = smoothVolume(gridOf({30, 26, 28}));
  const struct {
    const char* name;
    CameraChoice camera;
  } views[] = {
      {"fov 1", {.azimuthDeg = 70, .elevationDeg = 10, .verticalFovDeg = 1}},
      {"fov 120", {.azimuthDeg = -20, .elevationDeg = 60, .verticalFovDeg = 120}},
      // The eye is R / sin(fov / 2) away, 1e6 diagonals or 2e6 R.
      {"far eye", {.azimuthDeg = 130, .elevationDeg = 5, .verticalFovDeg = 5.7295779513e-5}}};
  for (const std::string style : {"plain", "all"}) {
    Scene scene = resolved(sceneOf(style), source);
    ComparedScene compared{scene, source};
    for (const auto& view : views) {
      scene.camera = view.camera;
      expectTrue(style + " " + view.name, compared, cameraOf(scene, source), smoothBound(style));
    }
  }
}

TEST_P(StableViews, EyeAtAFace) {
  // Where rays enter is off by 6nu = 1e-5 voxels, as anywhere; with extinction below 0.7 that is
  // below smoothBound however near the eye is.
  ArraySource source = smoothVolume(gridOf({30, 26, 28}));
  const VolumeGrid& grid = source.info().grid;
  for (const std::string style : {"plain", "all"}) {
    Scene scene = resolved(sceneOf(style), source);
    ComparedScene compared{scene, source};
    for (const double inside : {-1e-3, 0.0, 1e-3})
      for (const int axis : {0, 1, 2})
        for (const double fov : {30.0, 120.0}) {
          glm::dvec3 eye = grid.centreWorld() + glm::dvec3{1, 2, 3};
          eye[axis] = grid.boxIndex().hi[axis] - inside;
          scene.camera.verticalFovDeg = fov;
          scene.camera.eye = eye;
          scene.camera.target = grid.centreWorld();
          scene.camera.upVector = glm::dvec3{0.3, 1, 0.2};
          expectTrue(style + " " + std::to_string(inside) + " inside face " + std::to_string(axis),
                     compared, cameraOf(scene, source), smoothBound(style));
        }
  }
}

INSTANTIATE_TEST_SUITE_P(Classification, StableViews, testing::Bool(), classification);

}  // namespace
}  // namespace burin::test
