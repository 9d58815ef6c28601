// quality.max_error: the picture is as close to the converged one as was asked, on any ranks.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "bench/converged_picture.hpp"
#include "host/max_error_scenes.hpp"
#include "support/array_source.hpp"
#include "support/mpi_test.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

using namespace host;

constexpr double kTruth = 1e-4;  // what the reference, which has no step, may be off by

Image<Rgba> truthOf(const Communicator& comm, PreparedScene& scene) {
  return bench::convergedPicture(comm, scene, kTruth, resolveCamera(scene.scene, scene.facts));
}

void expectKept(const Communicator& comm, PreparedScene& scene, const Case& c) {
  const Image<Rgba> truth = truthOf(comm, scene);
  for (const double asked : {1.0 / 32, 1.0 / 128, 1.0 / 512}) {
    const Image<Rgba> picture = drawn(comm, scene, asked, true);
    if (comm.isRoot()) {
      EXPECT_LE(largestDifference(picture, truth), asked)
          << c.procedural << (c.spike ? " spiked" : "");
    }
  }
}

TEST(MaxError, IsKept) {
  const Communicator comm{MPI_COMM_WORLD};
  for (const Case& c :
       {Case{"ct-phantom", -400, 900, 0.5, false}, Case{"marschner-lobb", 0.3, 0.8, 0.6, false},
        Case{"vessels", 0.3, 0.9, 0.8, false}, Case{"vessels", 0.1, 0.5, 0.6, false, 64},
        Case{"ramp", 0.2, 0.9, 0.5, false}, Case{"ramp", 0.4, 0.42, 0.9, true},
        Case{"marschner-lobb", 0.5, 0.504, 0.9, true}, Case{"shells", 0.6, 0.61, 0.9, true},
        Case{"vessels", 0.5, 0.52, 0.9, true}}) {
    PreparedScene scene = prepared(c);
    expectKept(comm, scene, c);
  }
}

// A region's edges in value are cut at, those in gradient are found by halving.
TEST(MaxError, IsKeptByTwoDimensionalTransferFunctions) {
  const Communicator comm{MPI_COMM_WORLD};
  PreparedScene scene = prepared({"marschner-lobb", 0, 1, 0, false, 20});
  scene.scene.layers[0].transferFunction = gentleWidgets();
  scene.scene.layers[0].transferFunction.widgets[0].value = {0.45, 0.55};
  scene.scene.layers[0].transferFunction.widgets[0].opacity = 0.9;
  scene.scene.imageSize = {32, 32};
  resolveScene(scene.scene, scene.facts);
  const Image<Rgba> truth = truthOf(comm, scene);
  for (const double asked : {1.0 / 32, 1.0 / 256}) {
    const Image<Rgba> picture = drawn(comm, scene, asked, true);
    if (!comm.isRoot()) continue;
    std::printf("asked for %.2g, off by %.2g\n", asked, largestDifference(picture, truth));
    EXPECT_LE(largestDifference(picture, truth), asked);
  }
}

// Where voxels are not valid the field is no cubic within a cell, and ends half way to them. The
// ends are planes here: what a ray grazes of curved ones may lie between look-ups.
TEST(MaxError, IsKeptNextToVoxelsThatAreNotValid) {
  const Communicator comm{MPI_COMM_WORLD};
  const VolumeGrid grid = gridOf(glm::ivec3{20});
  const auto value = [](glm::ivec3 i) {
    if (i.x == 7 || i.z < 2) return std::numeric_limits<float>::quiet_NaN();
    return static_cast<float>(smoothField(glm::dvec3{i}));
  };
  for (const Case& c :
       {Case{"smooth", 0.2, 0.9, 0.5, false}, Case{"smooth", 0.5, 0.52, 0.9, true}}) {
    PreparedScene scene = prepared(c, std::make_unique<ArraySource>(grid, value));
    expectKept(comm, scene, c);
  }
}

TEST(MaxError, IsKeptByStepsOfTilesWithoutPreintegration) {
  const Communicator comm{MPI_COMM_WORLD};
  PreparedScene scene = prepared({"ramp", 0.2, 0.9, 0.5, false});
  const Image<Rgba> truth = truthOf(comm, scene);
  constexpr double kAsked = 1.0 / 128;
  const Image<Rgba> picture = drawn(comm, scene, kAsked, false);
  if (comm.isRoot()) {
    EXPECT_LE(largestDifference(picture, truth), kAsked);
  }
}

}  // namespace
}  // namespace burin::test
