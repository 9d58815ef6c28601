#include "burin/host/default_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <utility>

#include "burin/common/named_style.hpp"

namespace burin::host {
namespace {

VolumeChoice choice() {
  VolumeChoice volume;
  volume.file = "head.nrrd";
  return volume;
}

/// A profile with these counts and no gradients, and one block of all values.
struct Known {
  MaterialProfile profile;
  node::BlockRanges blocks;
};

Known known(std::vector<std::int64_t> counts, double lowest = 0, double binWidth = 1) {
  Known made;
  made.profile.histogram.lowest = lowest;
  made.profile.histogram.binWidth = binWidth;
  made.profile.gradientSums.resize(counts.size());
  made.profile.squareSums.resize(counts.size());
  made.profile.magnitudeCounts.resize(1);
  made.blocks.blocks = {1, 1, 1};
  made.blocks.lowest = {static_cast<float>(lowest)};
  made.blocks.highest = {
      static_cast<float>(lowest + binWidth * static_cast<double>(counts.size()))};
  made.profile.histogram.counts = std::move(counts);
  return made;
}

Scene sceneOf(const Known& volume, const VolumeFacts& facts) {
  return makeDefaultScene(choice(), facts, volume.profile, volume.blocks);
}

Scene sceneOf(const Known& volume) {
  VolumeFacts facts;
  facts.grid.dims = {64, 64, 64};
  return sceneOf(volume, facts);
}

TEST(DefaultScene, IsAValidSceneThatComesBackFromItsText) {
  const Scene scene = sceneOf(known({900, 950, 800, 0, 0, 0, 0, 40, 60, 30}));
  EXPECT_EQ(parseScene(writeScene(scene), "text"), scene);
  ASSERT_EQ(scene.layers.size(), 1u);
}

TEST(DefaultScene, IsTheNamedStyleIllustration) {
  const auto styles = findNamedStyles({std::filesystem::path{BURIN_STYLES_DIR}});
  const auto found = std::find_if(styles.begin(), styles.end(),
                                  [](const NamedStyle& s) { return s.name == "illustration"; });
  ASSERT_NE(found, styles.end());
  std::vector<StyleSettings> effects = sceneOf(known({900, 0, 100})).layers[0].styles;
  std::erase_if(effects, [](const StyleSettings& s) { return s.name == "gradient"; });
  EXPECT_EQ(effects, found->effects);
}

TEST(DefaultScene, HidesTheBackgroundAndShowsTheRest) {
  // Background in bins 0 … 2, things in 7 … 9.
  const TransferFunction function =
      sceneOf(known({900, 950, 800, 0, 0, 0, 0, 40, 60, 30})).layers[0].transferFunction;
  EXPECT_EQ(function.classify(2.9, 1).extinction, 0);
  EXPECT_GT(function.classify(7.0, 1).extinction, 0);
  EXPECT_GT(function.classify(9.5, 1).extinction, function.classify(7.0, 1).extinction);
}

/// 6³ blocks, those at the volume's faces of one range and the others of another one.
node::BlockRanges faceAndInside(const glm::vec2& atFaces, const glm::vec2& inside) {
  constexpr int kBlocks = 6;
  node::BlockRanges blocks;
  blocks.blockCells = 4;
  blocks.blocks = glm::ivec3{kBlocks};
  for (int z = 0; z < kBlocks; ++z)
    for (int y = 0; y < kBlocks; ++y)
      for (int x = 0; x < kBlocks; ++x) {
        const int nearest = std::min({x, y, z, kBlocks - 1 - x, kBlocks - 1 - y, kBlocks - 1 - z});
        const glm::vec2& range = nearest == 0 ? atFaces : inside;
        blocks.lowest.push_back(range[0]);
        blocks.highest.push_back(range[1]);
      }
  return blocks;
}

TEST(DefaultScene, OfBrightSurroundingsTheDarkThingsShow) {
  Known volume = known({40, 60, 30, 0, 0, 0, 0, 800, 950, 900});
  const TransferFunction dense = sceneOf(volume).layers[0].transferFunction;
  EXPECT_GT(dense.classify(9.5, 1).extinction, 0);
  volume.blocks = faceAndInside({8, 9}, {0, 9});
  const Scene scene = sceneOf(volume);
  const TransferFunction& function = scene.layers[0].transferFunction;
  EXPECT_EQ(function.classify(8.0, 1).extinction, 0);
  EXPECT_EQ(function.classify(9.9, 1).extinction, 0);
  EXPECT_GT(function.classify(1.5, 1).extinction, 0);
  EXPECT_GT(function.classify(0.0, 1).extinction, function.classify(2.5, 1).extinction);
  EXPECT_EQ(parseScene(writeScene(scene), "text"), scene);
  const StyleSpec& spec = *findStyle("gradient");
  const auto normal = std::ranges::find(spec.parameters, "normal", &ParameterSpec::name);
  EXPECT_EQ(std::get<std::string>(
                scene.layers[0]
                    .style("gradient")
                    ->values[static_cast<std::size_t>(normal - spec.parameters.begin())]),
            "inward");
}

TEST(DefaultScene, WhatFillsItsBoxShowsItsBoundaries) {
  Known volume = known({500, 0, 0, 0, 500});
  volume.blocks = faceAndInside({0, 0.5F}, {0, 5});
  EXPECT_EQ(sceneOf(volume).layers[0].style("surface"), nullptr);
  volume.blocks = faceAndInside({0, 5}, {0, 5});
  EXPECT_NE(sceneOf(volume).layers[0].style("surface"), nullptr);
}

TEST(DefaultScene, AMaterialBelowOtsusThresholdIsNoBackground) {
  // Background in bin 0, much in 4 … 6, little everywhere above, and more that is cut off at the
  // end.
  std::vector<std::int64_t> counts(32, 30);
  counts[0] = 7000;
  for (const std::size_t bin : {1U, 2U, 3U}) counts[bin] = 20;
  for (const std::size_t bin : {4U, 5U, 6U}) counts[bin] = 400;
  counts[31] = 300;
  Known volume = known(std::move(counts));
  ASSERT_GT(otsuThreshold(volume.profile.histogram), 7);
  const TransferFunction function = sceneOf(volume).layers[0].transferFunction;
  EXPECT_GT(function.classify(4, 1).extinction, 0);
  EXPECT_EQ(function.classify(0.9, 1).extinction, 0);
}

/// Background below 4, as much as `highest` says of each block but those of the first layer, which
/// reach 9; in an order in which the first ones are next to that layer.
Scene besideBright(const std::function<float(double part)>& highest) {
  Known volume = known({900, 20, 20, 20, 20, 0, 0, 0, 100, 100});
  constexpr int kBlocks = 8;
  volume.blocks = {};
  volume.blocks.blockCells = 8;
  volume.blocks.blocks = glm::ivec3{kBlocks};
  constexpr int kBright = kBlocks * kBlocks;
  constexpr int kAll = kBlocks * kBlocks * kBlocks;
  volume.blocks.lowest.assign(kAll, 0.0F);
  for (int i = 0; i < kAll; ++i)
    volume.blocks.highest.push_back(i < kBright ? 9.0F
                                                : highest((i - kBright + 0.5) / (kAll - kBright)));
  return sceneOf(volume);
}

TEST(DefaultScene, FaintThingsApartFromBrightOnesShow) {
  const auto shows = [](const Scene& scene, double value) {
    return scene.layers[0].transferFunction.classify(value, 1).extinction > 0;
  };
  // A group of its own: an eighth next to what is bright, as much as that apart.
  const Scene leaves =
      besideBright([](double part) { return part > 0.2 && part < 0.4 ? 3.0F : 1.0F; });
  EXPECT_TRUE(shows(leaves, 2.5));
  EXPECT_FALSE(shows(leaves, 1));
  EXPECT_EQ(leaves.layers[0].transferFunction.points.size(), 6u) << "what is bright lies within";
  // Values of a field, spread evenly.
  const Scene field =
      besideBright([](double part) { return static_cast<float>(3.9 * (1 - part)); });
  EXPECT_TRUE(shows(field, 3));
  // Noise: each value rarer than the ones below it.
  const Scene noise = besideBright(
      [](double part) { return static_cast<float>(std::min(3.9, -0.8 * std::log(part))); });
  EXPECT_FALSE(shows(noise, 3));
  // Too few.
  const Scene specks =
      besideBright([](double part) { return part > 0.2 && part < 0.22 ? 3.0F : 1.0F; });
  EXPECT_FALSE(shows(specks, 3));
  // What fills the volume.
  const Scene medium = besideBright([](double part) { return part > 0.2 ? 3.0F : 1.0F; });
  EXPECT_FALSE(shows(medium, 3));
}

/// 16³ blocks of 4³ cells with these ranges, of few values that are not 0.
Known knownBlocks(const std::function<std::pair<float, float>(const glm::ivec3&)>& rangeOf) {
  constexpr int kBlocks = 16;
  Known volume = known({900, 0, 0, 0, 0, 100});
  volume.blocks = {};
  volume.blocks.blockCells = 4;
  volume.blocks.blocks = glm::ivec3{kBlocks};
  for (int z = 0; z < kBlocks; ++z)
    for (int y = 0; y < kBlocks; ++y)
      for (int x = 0; x < kBlocks; ++x) {
        const auto [lowest, highest] = rangeOf({x, y, z});
        volume.blocks.lowest.push_back(lowest);
        volume.blocks.highest.push_back(highest);
      }
  return volume;
}

/// A ball of 5 within 0, with values between at the places of blocks for which `isRough`.
Scene ballScene(const std::function<bool(const glm::ivec3&)>& isRough, const VolumeFacts& facts) {
  const Known volume = knownBlocks([&](const glm::ivec3& block) {
    const double radius = glm::length(glm::dvec3{block} - 7.5);
    const bool isShown = radius < 6;
    return std::pair{isShown && radius < 5 && !isRough(block) ? 5.0F : 0.0F, isShown ? 5.0F : 0.0F};
  });
  return sceneOf(volume, facts);
}

TEST(DefaultScene, LooksFromTheSideOfMostBoundaries) {
  VolumeFacts facts;
  facts.grid.dims = {65, 65, 65};
  const auto lowZ = [](const glm::ivec3& block) { return block.z < 6; };
  const auto highZ = [](const glm::ivec3& block) { return block.z > 9; };
  // y is up: the eye is at high z unless turned.
  EXPECT_EQ(ballScene(highZ, facts).camera.azimuthDeg, 30);
  EXPECT_EQ(ballScene(lowZ, facts).camera.azimuthDeg, 210);
  const auto highY = [](const glm::ivec3& block) { return block.y > 9; };
  facts.grid.spacing = {1, 1, 1.2};  // slices: z is up and the eye at low y
  EXPECT_EQ(ballScene(highY, facts).camera.azimuthDeg, 210);
  facts.anatomical = true;  // the file says where the front is
  EXPECT_EQ(ballScene(highY, facts).camera.azimuthDeg, 30);
}

/// 16³ blocks of 5 where `isShown`, else of 0.
CameraChoice viewOf(const std::function<bool(const glm::ivec3&)>& isShown) {
  VolumeFacts facts;
  facts.grid.dims = {65, 65, 65};
  const Known volume = knownBlocks([&](const glm::ivec3& block) {
    const float value = isShown(block) ? 5.0F : 0.0F;
    return std::pair{value, value};
  });
  return sceneOf(volume, facts).camera;
}

TEST(DefaultScene, WhatStandsOnAFloorStandsUpright) {
  const auto floor = [](const glm::ivec3& b) {
    return b.z == 15 || (b.x == 3 && b.y == 6 && b.z > 4);
  };
  EXPECT_EQ(viewOf(floor).upAxis, "z");
  EXPECT_EQ(viewOf([&](const glm::ivec3& b) { return floor({b.y, b.z, b.x}); }).upAxis, "y");
}

TEST(DefaultScene, LooksAtTheBroadSideInTheWorld) {
  VolumeFacts facts;
  facts.anatomical = true;
  facts.grid.dims = {65, 65, 65};
  const auto blade = [](const glm::ivec3& b) {
    return std::abs(b.x - 8) < 2 && std::abs(b.y - 8) < 2 && std::abs(b.z - 8) < 6;
  };
  const Known volume = knownBlocks([&](const glm::ivec3& block) {
    const float value = blade(block) ? 5.0F : 0.0F;
    return std::pair{value, value};
  });
  EXPECT_EQ(sceneOf(volume, facts).camera.azimuthDeg, 30);    // it is as deep as it is wide
  facts.grid.direction = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};  // its planes are coronal
  EXPECT_EQ(sceneOf(volume, facts).camera.azimuthDeg, 60);
}

/// The place farthest out of all that shows, as a share of half the picture.
double farthestOut(const Scene& scene, const VolumeFacts& facts,
                   const std::function<bool(const glm::ivec3&)>& isShown) {
  const Camera camera = resolveCamera(scene, facts);
  double farthest = 0;
  for (int i = 0; i < 16 * 16 * 16 * 8; ++i) {
    const glm::ivec3 block{i / 8 % 16, i / 128 % 16, i / 2048};
    if (!isShown(block)) continue;
    const glm::ivec3 corner = 4 * (block + glm::ivec3{i & 1, (i >> 1) & 1, (i >> 2) & 1});
    const glm::dvec3 ray = facts.grid.worldFromIndex(glm::dvec3{corner}) - camera.eyeWorld;
    const glm::dvec2 place = glm::dvec2{glm::dot(ray, camera.right), glm::dot(ray, camera.up)} /
                             (glm::dot(ray, camera.forward) * camera.pixelSize);
    farthest = std::max({farthest, 2 * std::abs(place.x) / camera.image.width,
                         2 * std::abs(place.y) / camera.image.height});
  }
  return farthest;
}

TEST(DefaultScene, WhatShowsFillsThePicture) {
  VolumeFacts facts;
  facts.grid.dims = {65, 65, 65};
  const auto ball = [](const glm::ivec3& b) { return glm::length(glm::dvec3{b} - 7.5) < 6; };
  const auto rod = [](const glm::ivec3& b) { return b.x == b.y && b.y == b.z && b.x > 2; };
  for (const auto isShown : {+ball, +rod}) {
    const Known volume = knownBlocks([&](const glm::ivec3& block) {
      const float value = isShown(block) ? 5.0F : 0.0F;
      return std::pair{value, value};
    });
    const Scene scene = sceneOf(volume, facts);
    const double farthest = farthestOut(scene, facts, isShown);
    EXPECT_LE(farthest, 0.94);
    EXPECT_GT(farthest, 0.94 * (1 - 0.05 / scene.camera.zoom));  // zooms are multiples of 0.05
  }
}

TEST(DefaultScene, TablesLieBelow) {
  // A ball in the middle, a sheet a little away from it, and a speck beyond the sheet.
  const auto onTable = [](const glm::ivec3& b) {
    const bool isBall = glm::length(glm::dvec3{b} - glm::dvec3{6.5, 8.5, 7.5}) < 4;
    const bool isTable = b.y == 3 && b.x > 0 && b.x < 15 && b.z > 0 && b.z < 15;
    return isBall || isTable || b == glm::ivec3{4, 1, 4};
  };
  EXPECT_EQ(viewOf(onTable).elevationDeg, 20);
  EXPECT_EQ(viewOf([&](const glm::ivec3& b) {
              return onTable({b.x, 15 - b.y, b.z});
            }).elevationDeg,
            -160);
}

TEST(DefaultScene, ConstantAndEmptyVolumesAreValidToo) {
  const auto parse = [](const Known& volume) {
    return parseScene(writeScene(sceneOf(volume)), "text");
  };
  EXPECT_NO_THROW(parse(known({27}, 5)));
  EXPECT_NO_THROW(parse(known({0})));
  EXPECT_NO_THROW(parse(known(std::vector<std::int64_t>(1000, 1), 0, 1e-23)));
}

TEST(DefaultScene, LookDoesNotDependOnResolution) {
  const Known volume = known({900, 0, 100});
  VolumeFacts coarse, fine;
  coarse.grid.dims = {65, 65, 65};
  coarse.grid.spacing = {2, 2, 2};
  fine.grid.dims = {129, 129, 129};
  const Scene a = sceneOf(volume, coarse);
  const Scene b = sceneOf(volume, fine);
  EXPECT_EQ(a.layers[0].transferFunction, b.layers[0].transferFunction);
}

}  // namespace
}  // namespace burin::host
