// quality.max_error: the picture is as close to the converged one as was asked, on any ranks.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "burin/host/frame_maker.hpp"
#include "support/mpi_test.hpp"

namespace burin::test {
namespace {

using namespace host;

/// Opacity from 0 to `opacity` over [first, last] of the kind's values: smooth, or a narrow spike.
struct Case {
  const char* procedural;
  double first, last, opacity;
  bool spike;
};

PreparedScene prepared(const Case& c) {
  PreparedScene made;
  made.scene.volume.procedural = c.procedural;
  made.scene.volume.dims = glm::ivec3{28, 28, 28};
  made.source = node::openVolume(made.scene.volume);
  made.facts = {made.source->info().grid, false};
  Layer layer;
  layer.name = c.procedural;
  if (c.spike)
    layer.transferFunction.points = {{c.first, {255, 160, 60}, 0},
                                     {(c.first + c.last) / 2, {255, 160, 60}, c.opacity},
                                     {c.last, {255, 160, 60}, 0}};
  else
    layer.transferFunction.points = {{c.first, {60, 90, 200}, 0},
                                     {c.last, {250, 220, 160}, c.opacity}};
  made.scene.layers = {layer};
  made.scene.imageSize = {64, 64};
  resolveScene(made.scene, made.facts);
  return made;
}

double largestDifference(ImageView<const Rgba> a, ImageView<const Rgba> b) {
  double largest = 0;
  for (std::size_t i = 0; i < b.pixels().size(); ++i) {
    const Rgba& p = a.pixels()[i];
    const Rgba& q = b.pixels()[i];
    for (const float d : {p.r - q.r, p.g - q.g, p.b - q.b, p.a - q.a})
      largest = std::max(largest, std::abs(double{d}));
  }
  return largest;
}

TEST(MaxError, IsKept) {
  const Communicator comm{MPI_COMM_WORLD};
  for (const Case& c :
       {Case{"ct-phantom", -400, 900, 0.5, false}, Case{"marschner-lobb", 0.3, 0.8, 0.6, false},
        Case{"vessels", 0.3, 0.9, 0.8, false}, Case{"ramp", 0.2, 0.9, 0.5, false},
        Case{"ramp", 0.4, 0.42, 0.9, true}}) {
    PreparedScene scene = prepared(c);
    const Camera camera = resolveCamera(scene.scene, scene.facts);
    // Converged: at twice this step the worst of these pictures, the vessels, is off by 2e-4.
    scene.scene.quality = {1.0 / 64, 0, true, {}};
    RankStatistics unused;
    const auto reference = makeReferenceFrames(comm, scene, {}, [](double) {});
    const ImageView<const Rgba> truth = reference->make(camera, unused);
    for (const double asked : {1.0 / 32, 1.0 / 128, 1.0 / 512}) {
      scene.scene.quality = Quality{};
      scene.scene.quality.maxError = asked;
      const auto frames = makeRaycastFrames(comm, scene, {}, {});
      const ImageView<const Rgba> picture = frames->make(camera, unused);
      if (!comm.isRoot()) continue;
      EXPECT_LE(largestDifference(picture, truth), asked) << c.procedural << " " << c.spike;
    }
  }
}

}  // namespace
}  // namespace burin::test
