#include "macrocells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "chessboard_distance.hpp"

namespace burin::node {
namespace {

/// A grid of values with its box, and brute-force answers.
struct Values {
  IndexBox box;
  std::vector<float> stored;

  float at(glm::ivec3 v) const {
    const glm::ivec3 i = v - box.lo;
    const glm::ivec3 size = box.size();
    return stored[static_cast<std::size_t>((i.z * size.y + i.y) * size.x + i.x)];
  }
};

Values randomValues(const IndexBox& box, unsigned seed) {
  std::mt19937 random{seed};
  std::uniform_real_distribution<float> unit{0, 1};
  Values values{box, std::vector<float>(box.count())};
  // Mostly low, a few high: so that distances are interesting.
  for (float& v : values.stored) v = unit(random) < 0.004f ? 1.0f : 0.1f * unit(random);
  return values;
}

Macrocells macrocellsOf(const Values& values) {
  Macrocells cells{values.box};
  cells.add(values.box, values.stored);
  cells.finish();
  return cells;
}

/// Whether any voxel of a macrocell (shared faces included) is above a half.
bool hasHigh(const Values& values, glm::ivec3 firstVoxel) {
  for (int z = 0; z <= kMacrocellSize; ++z)
    for (int y = 0; y <= kMacrocellSize; ++y)
      for (int x = 0; x <= kMacrocellSize; ++x) {
        const glm::ivec3 v = firstVoxel + glm::ivec3{x, y, z};
        const bool inside = glm::all(glm::greaterThanEqual(v, values.box.lo)) &&
                            glm::all(glm::lessThan(v, values.box.hi));
        if (inside && values.at(v) > 0.5f) return true;
      }
  return false;
}

TEST(Macrocells, DistancesAreChessboardDistancesToVisibleOnes) {
  for (const IndexBox& box : {IndexBox{{0, 0, 0}, {33, 30, 18}}, IndexBox{{5, 3, 7}, {40, 29, 26}},
                              IndexBox{{8, 8, 8}, {9, 20, 13}}}) {
    const Values values = randomValues(box, 3);
    const Macrocells cells = macrocellsOf(values);
    const glm::ivec3 size = cells.size();
    const auto distances = signedChessboardDistance(
        cells.mark([](float, float highest) { return highest > 0.5f; }), size);
    ASSERT_EQ(distances.size(), static_cast<std::size_t>(size.x * size.y * size.z));
    std::vector<glm::ivec3> occupied;
    const auto forEach = [&](auto visit) {
      for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
          for (int x = 0; x < size.x; ++x)
            visit(glm::ivec3{x, y, z},
                  distances[static_cast<std::size_t>((z * size.y + y) * size.x + x)]);
    };
    forEach([&](glm::ivec3 c, int) {
      if (hasHigh(values, cells.origin() + kMacrocellSize * c)) occupied.push_back(c);
    });
    forEach([&](glm::ivec3 c, int distance) {
      int nearest = kLargestDistance;
      for (const glm::ivec3& o : occupied) {
        const glm::ivec3 d = glm::abs(o - c);
        nearest = std::min(nearest, std::max({d.x, d.y, d.z}));
      }
      // Widening towards a neighbour's range may make a macrocell next to a visible one visible.
      EXPECT_LE(std::max(distance, 0), nearest);
      EXPECT_GE(std::max(distance, 0), nearest - 1);
    });
  }
}

TEST(Macrocells, WideningIsAFractionOfTheNeighboursRange) {
  // 0 left of voxel 4, 1 at and right of 8: the macrocells' own ranges are [0,0], [0,1] and [1,1].
  const IndexBox box{{0, 0, 0}, {13, 5, 5}};
  Values values{box, std::vector<float>(box.count())};
  std::size_t i = 0;
  for (int z = 0; z < 5; ++z)
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 13; ++x, ++i)
        values.stored[i] = std::clamp(static_cast<float>(x - 4) / 4.0f, 0.0f, 1.0f);
  const Macrocells cells = macrocellsOf(values);
  ASSERT_EQ(cells.size(), (glm::ivec3{3, 1, 1}));
  std::vector<std::pair<float, float>> ranges;
  cells.mark([&](float lowest, float highest) {
    ranges.emplace_back(lowest, highest);
    return true;
  });
  constexpr float w = 0x1p-8f;
  EXPECT_THAT(ranges, testing::ElementsAre(std::pair{0.0f, w}, std::pair{0.0f, 1.0f},
                                           std::pair{1 - w, 1.0f}));
}

TEST(Macrocells, SlabsInAnyCutGiveTheSameRanges) {
  const Values values = randomValues({{2, 1, 3}, {27, 22, 25}}, 11);
  const Macrocells whole = macrocellsOf(values);
  Macrocells cut{values.box};
  const std::size_t slice = values.stored.size() / 22;
  for (int z = 3; z < 25; z += 3) {
    const IndexBox slab{{2, 1, z}, {27, 22, std::min(z + 3, 25)}};
    cut.add(slab, std::span{values.stored}.subspan(static_cast<std::size_t>(z - 3) * slice,
                                                   slab.count()));
  }
  cut.finish();
  const auto high = [](float, float highest) { return highest > 0.5f; };
  EXPECT_EQ(whole.mark(high), cut.mark(high));
}

TEST(Macrocells, NanIsNothing) {
  const IndexBox box{{0, 0, 0}, {9, 9, 9}};
  Macrocells cells{box};
  cells.add(box, std::vector<float>(box.count(), std::nanf("")));
  cells.finish();
  const auto marks = cells.mark([](float, float) { return true; });
  EXPECT_THAT(marks, testing::Each(0));
  EXPECT_TRUE(cells.boxOf(marks).empty());
}

}  // namespace
}  // namespace burin::node
