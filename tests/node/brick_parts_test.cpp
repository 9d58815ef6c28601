// Bricks hold only what the scene may show of them: the picture is that of whole bricks, edits load
// what they need, and memory is what is stored.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "support/drawing.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

// Textures of other sizes, as in brick_invariance_test.cpp.
constexpr double kLargestOfParts = 5e-5;
constexpr double kRmsOfParts = 2e-6;

/// Balls in emptiness, values rising from 0 at their surface to 1 over a dozen voxels; u16.
ArraySource balls(const glm::ivec3& dims) {
  const std::vector<glm::dvec3> centres{{14, 15, 60}, {70, 40, 20}, {45, 20, 40}};
  return ArraySource::of<std::uint16_t>(gridOf(dims), node::VoxelType::kU16, [=](glm::ivec3 i) {
    double value = 0;
    for (const glm::dvec3& centre : centres)
      value = std::max(value, 1 - glm::distance(glm::dvec3{i}, centre) / 14);
    return static_cast<std::uint16_t>(std::lround(60000 * value));
  });
}

/// Shows values from `first` on.
Scene ballScene(const std::string& style, double first) {
  Scene scene = sceneWithStyle(style);
  scene.layers[0].transferFunction = {
      {{first, {250, 230, 200}, 0}, {first + 30000, {200, 40, 30}, 0.5}}, {}};
  if (!scene.layers[0].lineOpacity.empty())
    scene.layers[0].lineOpacity = {{first, 0}, {first + 20000, 0.3}};
  return scene;
}

TEST(BrickParts, ThePictureIsThatOfWholeBricks) {
  ArraySource source = balls({112, 60, 72});
  int i = 0;
  for (const std::string& style : drawnStyles()) {
    Scene scene = ballScene(style, 4000 + 9000 * (i % 3));
    scene.camera.azimuthDeg = 70 * i;
    scene.quality.preintegrated = i % 2 == 0;
    scene.quality.stepVoxels = i % 4 == 0 ? 2.5 : 0.5;
    if (i % 3 == 2) scene.clip = {{{1, 0.4, 0.1}, -40}};
    scene = resolved(scene, source);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    for (const int bricks : {1, 5}) {
      RankStatistics parts, whole, off;
      const auto drawn = drawAlone(scene, source, camera, {.bricks = bricks}, &parts);
      const auto all =
          drawAlone(scene, source, camera, {.bricks = bricks, .wholeBricks = true}, &whole);
      const auto unskipped =
          drawAlone(scene, source, camera, {.bricks = bricks, .skip = false}, &off);
      EXPECT_GT(largestAlpha(all), 0.3);
      const Difference d = difference(drawn, all);
      EXPECT_LE(d.largest, kLargestOfParts) << style << " " << bricks;
      EXPECT_LE(d.rms, kRmsOfParts) << style << " " << bricks;
      EXPECT_TRUE(std::ranges::equal(drawn.pixels(), unskipped.pixels())) << style;
      EXPECT_LT(parts.residentVoxelBytes, whole.residentVoxelBytes) << style << " " << bricks;
      EXPECT_EQ(parts.residentVoxelBytes, off.residentVoxelBytes);
      EXPECT_EQ(parts.bricks, whole.bricks);
    }
    ++i;
  }
}

TEST(BrickParts, EditsLoadWhatTheyNeed) {
  std::mt19937 random{21};
  ArraySource source = balls({112, 60, 72});
  Scene scene = resolved(ballScene("light", 50000), source);
  const Communicator self{MPI_COMM_SELF};
  const auto workerWith = [&](bool skip, bool whole) {
    return node::Worker{self, scene, source, {.bricks = 4, .skip = skip, .wholeBricks = whole}};
  };
  node::Worker on = workerWith(true, false);
  node::Worker off = workerWith(false, false);
  node::Worker whole = workerWith(true, true);
  int grown = 0;
  std::int64_t before = 0;
  for (int i = 0; i < 16; ++i) {
    // More and more shows, with some back and forth.
    const double first = 54000 - 3300 * i + 100.0 * static_cast<double>(random() % 60);
    scene.layers[0].transferFunction = ballScene("light", first).layers[0].transferFunction;
    scene.clip.clear();
    if (i % 3 == 1) scene.clip.push_back({{1, 0, 0.2}, -10.0 * static_cast<double>(random() % 8)});
    scene.camera.azimuthDeg += 65;
    scene = resolved(scene, source);
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    std::vector<Image<Rgba>> images;
    std::vector<RankStatistics> statistics(3);
    std::size_t k = 0;
    for (node::Worker* worker : {&on, &off, &whole}) {
      worker->update(scene);
      images.push_back(wholeFrame(worker->draw(camera, statistics[k++])));
    }
    EXPECT_TRUE(std::ranges::equal(images[0].pixels(), images[1].pixels())) << "edit " << i;
    const Difference d = difference(images[0], images[2]);
    EXPECT_LE(d.largest, kLargestOfParts) << "edit " << i;
    EXPECT_LE(d.rms, kRmsOfParts) << "edit " << i;
    const std::int64_t bytes = statistics[0].residentVoxelBytes;
    EXPECT_EQ(bytes, statistics[1].residentVoxelBytes);
    EXPECT_LE(bytes, statistics[2].residentVoxelBytes);
    grown += bytes > before ? 1 : 0;
    before = bytes;
  }
  EXPECT_GE(grown, 3);
}

TEST(BrickParts, AnEmptyBrickIsDrawnAloneAsNothing) {
  ArraySource source = balls({112, 60, 72});
  const Scene scene = resolved(ballScene("plain", 70000), source);  // above all values
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const Communicator self{MPI_COMM_SELF};
  node::Worker worker{self, scene, source, {.bricks = 3}};
  EXPECT_TRUE(worker.visibilityOrder(camera).empty());
  RankStatistics statistics;
  const auto drawn = worker.drawBrick(BrickId{1}, camera, statistics,
                                      [](std::size_t) { return std::span<Rgba>{}; });
  EXPECT_TRUE(drawn.active.empty());
  EXPECT_EQ(drawn.frame, camera.image);
  EXPECT_EQ(statistics.residentVoxelBytes, 0);
  EXPECT_EQ(statistics.bricks, 1);
  EXPECT_THROW(worker.drawBrick(BrickId{3}, camera, statistics,
                                [](std::size_t) { return std::span<Rgba>{}; }),
               std::logic_error);
}

TEST(BrickParts, MemoryIsThatOfTheStoredBoxAndAFifthAtMost) {
  const auto bytes = [](ArraySource& source, const Scene& scene) {
    const Camera camera = resolveCamera(scene, {source.info().grid, false});
    RankStatistics statistics;
    drawAlone(scene, source, camera, {}, &statistics);
    return static_cast<double>(statistics.residentVoxelBytes);
  };
  // All shows: the stored box is the volume. Of u8, u16 (2 bytes a voxel) and float (4). The
  // macrocells' ranges and map take 14 bytes per 64 voxels (of floats 18), the blocks' ranges and
  // marks 9: 18 % of two bytes a voxel; the rest is for what does not grow with the volume.
  const VolumeGrid grid = gridOf({129, 101, 77});
  const auto voxels = static_cast<double>(grid.voxelCount());
  const auto opaque = [](double top) {
    Scene scene = sceneWithStyle("light");
    scene.layers[0].transferFunction = {{{0, {255, 0, 0}, 0.1}, {top, {255, 0, 0}, 0.2}}, {}};
    return scene;
  };
  const auto mixed = [](glm::ivec3 i) { return (7 * i.x + 5 * i.y + 3 * i.z) % 200; };
  ArraySource u8 = ArraySource::of<std::uint8_t>(grid, node::VoxelType::kU8, [&](glm::ivec3 i) {
    return static_cast<std::uint8_t>(mixed(i));
  });
  ArraySource u16 = ArraySource::of<std::uint16_t>(grid, node::VoxelType::kU16, [&](glm::ivec3 i) {
    return static_cast<std::uint16_t>(99 * mixed(i));
  });
  ArraySource f32{grid, [&](glm::ivec3 i) { return static_cast<float>(mixed(i)); }};
  for (ArraySource* source : {&u8, &u16}) {
    EXPECT_GE(bytes(*source, resolved(opaque(255), *source)), 2 * voxels);
    EXPECT_LE(bytes(*source, resolved(opaque(255), *source)), 1.2 * 2 * voxels);
  }
  EXPECT_GE(bytes(f32, resolved(opaque(255), f32)), 4 * voxels);
  EXPECT_LE(bytes(f32, resolved(opaque(255), f32)), 1.2 * 4 * voxels);

  // A ball in the blocks from 24 to 56 of 96: with what a segment reaches (1), a cell for rounding
  // and a ghost layer, voxels 21 … 59.
  ArraySource ball{gridOf({97, 97, 97}), [](glm::ivec3 i) {
                     const double r = glm::distance(glm::dvec3{i}, glm::dvec3{40});
                     return static_cast<float>(std::max(1 - r / 15, 0.0));
                   }};
  Scene scene = opaque(1);
  scene.layers[0].transferFunction.points[0].opacity = 0;
  const double everywhere = 9.0 * 24 * 24 * 24;  // the whole volume's blocks of 4³ cells
  EXPECT_GE(bytes(ball, resolved(scene, ball)), everywhere + 4.0 * 39 * 39 * 39);
  EXPECT_LE(bytes(ball, resolved(scene, ball)), everywhere + 1.2 * 4.0 * 39 * 39 * 39);
}

}  // namespace
}  // namespace burin::test
