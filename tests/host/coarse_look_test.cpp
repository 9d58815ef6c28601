#include "coarse_look.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace burin::host {
namespace {

constexpr int kBlocks = 8;
constexpr int kCells = 4;  // of a block

VolumeGrid grid() {
  VolumeGrid made;
  made.dims = glm::ivec3{kBlocks * kCells + 1};
  return made;
}

/// Blocks of one value each.
node::BlockRanges blocksOf(const std::function<float(const glm::ivec3&)>& value) {
  node::BlockRanges blocks;
  blocks.blockCells = kCells;
  blocks.blocks = glm::ivec3{kBlocks};
  for (int z = 0; z < kBlocks; ++z)
    for (int y = 0; y < kBlocks; ++y)
      for (int x = 0; x < kBlocks; ++x) blocks.lowest.push_back(value({x, y, z}));
  blocks.highest = blocks.lowest;
  return blocks;
}

/// Nothing at 0, a skin of extinction 0.02 at 1, a core of 0.5 at 2.
TransferFunction skinAndCore() {
  TransferFunction function;
  function.points = {{0, {}, 0}, {1, {}, -std::expm1(-0.02)}, {2, {}, -std::expm1(-0.5)}};
  function.opacityUnitLength = 1;
  return function;
}

CoarseLook look(const std::function<float(const glm::ivec3&)>& value,
                const glm::dvec3& forward = {0, 0, 1}) {
  return {grid(), blocksOf(value), skinAndCore(), 1.5, glm::normalize(forward)};
}

TEST(CoarseLook, ASlabDimsByItsThickness) {
  // Two layers of blocks: 8 world units along z.
  const auto slab = look([](const glm::ivec3& block) { return block.z < 2 ? 1.0f : 0.0f; });
  EXPECT_NEAR(slab.withSkin(1).skin, -std::expm1(-0.02 * 8), 1e-12);
  EXPECT_NEAR(slab.withSkin(5).skin, -std::expm1(-0.1 * 8), 1e-12);
  EXPECT_EQ(slab.withSkin(1).core, 1) << "there is none";
}

TEST(CoarseLook, RaysAskewAreLonger) {
  // Every ray at 45 degrees through a slab normal to z passes √2 times its thickness, but those
  // that enter or leave it by its sides: 2 of 9 rows of rays, whose other block lies outside.
  const auto slab =
      look([](const glm::ivec3& block) { return block.z < 2 ? 1.0f : 0.0f; }, {0, 1, 1});
  const double whole = -std::expm1(-0.02 * 8 * std::sqrt(2.0));
  const double half = -std::expm1(-0.02 * 4 * std::sqrt(2.0));
  EXPECT_NEAR(slab.withSkin(1).skin, (7 * whole + 2 * half) / 9, 1e-12);
}

TEST(CoarseLook, ASkinHidesWhatLiesBehindIt) {
  const auto value = [](const glm::ivec3& block) { return block.z < 3 ? 1.0f : 2.0f; };
  EXPECT_NEAR(look(value).withSkin(1).core, std::exp(-0.02 * 12), 1e-12);
  EXPECT_NEAR(look(value).withSkin(2).core, std::exp(-0.04 * 12), 1e-12);
  EXPECT_NEAR(look(value, {0, 0, -1}).withSkin(1).core, 1, 1e-12) << "the skin lies behind";
}

TEST(CoarseLook, OnlyRaysWithoutACoreTellHowMuchSkinIsSeen) {
  const auto value = [](const glm::ivec3& block) { return block.x < 4 ? 2.0f : 1.0f; };
  EXPECT_NEAR(look(value).withSkin(1).skin, -std::expm1(-0.02 * kBlocks * kCells), 1e-12);
}

}  // namespace
}  // namespace burin::host
