#include "macrocells.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
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

/// Values above a limit show.
struct Above {
  float limit;
  bool any(float, float highest) const { return highest > limit; }
  bool all(float lowest, float) const { return lowest > limit; }
};

/// Everything shows; keeps the ranges it is asked about. `isUniform`: and shows all over a
/// macrocell, so that its octants are not asked for.
struct Recorder {
  std::vector<ValueRange>& ranges;
  bool isUniform = true;
  bool any(float lowest, float highest) const {
    ranges.push_back({lowest, highest});
    return true;
  }
  bool all(float, float) const { return isUniform; }
};

Macrocells macrocellsOf(const Values& values, bool isWhole = false) {
  Macrocells cells{values.box, isWhole};
  cells.add(values.box, values.stored);
  cells.finish();
  return cells;
}

/// Whether any voxel of a cube of cells (shared faces included) is above a half.
bool hasHigh(const Values& values, glm::ivec3 firstVoxel, int cubeCells) {
  for (int z = 0; z <= cubeCells; ++z)
    for (int y = 0; y <= cubeCells; ++y)
      for (int x = 0; x <= cubeCells; ++x) {
        const glm::ivec3 v = firstVoxel + glm::ivec3{x, y, z};
        const bool inside = glm::all(glm::greaterThanEqual(v, values.box.lo)) &&
                            glm::all(glm::lessThan(v, values.box.hi));
        if (inside && values.at(v) > 0.5f) return true;
      }
  return false;
}

const std::array kBoxes{IndexBox{{0, 0, 0}, {33, 30, 18}}, IndexBox{{5, 3, 7}, {40, 29, 26}},
                        IndexBox{{8, 8, 8}, {9, 20, 13}}};

TEST(Macrocells, DistancesAreChessboardDistancesToVisibleOnes) {
  for (const IndexBox& box : kBoxes) {
    const Values values = randomValues(box, 3);
    const Macrocells cells = macrocellsOf(values);
    const glm::ivec3 size = cells.size();
    const std::vector<std::uint8_t> distances = chessboardDistance(cells.mark(Above{0.5f}), size);
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
      if (hasHigh(values, cells.origin() + kMacrocellSize * c, kMacrocellSize))
        occupied.push_back(c);
    });
    forEach([&](glm::ivec3 c, int distance) {
      int nearest = kLargestDistance;
      for (const glm::ivec3& o : occupied) {
        const glm::ivec3 d = glm::abs(o - c);
        nearest = std::min(nearest, std::max({d.x, d.y, d.z}));
      }
      // Low values are at most 0.1, and widening adds 2^-8 of 1 at most.
      EXPECT_EQ(distance, nearest);
    });
  }
}

TEST(Macrocells, OctantsWithoutVisibleVoxelsAreEmpty) {
  // Octants of low values reach up to 0.1, 2^-8 for their neighbours, and at most one of the code's
  // steps more, (2 n + 1) / 225 at the n-th; that is 0.15, far from the half where values show.
  for (const IndexBox& box : kBoxes)
    for (const bool isWhole : {false, true}) {
      const Values values = randomValues(box, 5);
      const Macrocells cells = macrocellsOf(values, isWhole);
      const std::vector<OctantMask> masks = cells.mark(Above{0.5f});
      const CubeGrid cubes = cells.cubes();
      int occupied = 0;
      for (int z = 0; z < 2 * cubes.size.z; ++z)
        for (int y = 0; y < 2 * cubes.size.y; ++y)
          for (int x = 0; x < 2 * cubes.size.x; ++x) {
            const glm::ivec3 octant{x, y, z};
            const glm::ivec3 odd = octant % 2;
            const bool marked =
                (masks[cubes.index(octant / 2)] >> (odd.x + 2 * odd.y + 4 * odd.z) & 1) != 0;
            const bool visible =
                hasHigh(values, cells.origin() + kMacrocellSize / 2 * octant, kMacrocellSize / 2);
            EXPECT_EQ(marked, visible);
            occupied += visible ? 1 : 0;
          }
      EXPECT_GT(occupied, 0);
    }
}

TEST(Macrocells, WideningIsAFractionOfTheNeighboursRange) {
  // 0 up to voxel 4, 1 from voxel 8 on. The octants' own ranges are twice [0, 0], then [0, 1/2],
  // [1/2, 1] and twice [1, 1]; the second one is widened by half of 2^-8, and the fifth.
  const IndexBox box{{0, 0, 0}, {13, 5, 5}};
  Values values{box, std::vector<float>(box.count())};
  std::size_t i = 0;
  for (int z = 0; z < 5; ++z)
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 13; ++x, ++i)
        values.stored[i] = std::clamp(static_cast<float>(x - 4) / 4.0f, 0.0f, 1.0f);
  const Macrocells cells = macrocellsOf(values);
  ASSERT_EQ(cells.size(), (glm::ivec3{3, 1, 1}));
  std::vector<ValueRange> ranges;
  cells.mark(Recorder{ranges});
  ASSERT_EQ(ranges.size(), 3);
  constexpr float w = 0x1p-9f;
  EXPECT_EQ(ranges[0].lowest, 0.0f);
  EXPECT_EQ(ranges[0].highest, w);
  EXPECT_EQ(ranges[1].lowest, 0.0f);
  EXPECT_EQ(ranges[1].highest, 1.0f);
  EXPECT_EQ(ranges[2].lowest, 1 - w);
  EXPECT_EQ(ranges[2].highest, 1.0f);
}

TEST(MacrocellRanges, AreWiderByLessThanAStepAndNeverNarrower) {
  std::mt19937 random{13};
  std::uniform_real_distribution<float> unit{0, 1};
  for (const bool isWhole : {false, true}) {
    constexpr std::size_t kCount = 200;
    MacrocellRanges kept{kCount, isWhole};
    std::vector<std::array<ValueRange, kOctants>> given(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      const float origin = unit(random);
      const float width =
          std::pow(unit(random), 8.0f) * (1 - origin);  // down to one texel and less
      for (ValueRange& octant : given[i]) {
        const float a = origin + width * unit(random);
        const float b = origin + width * unit(random);
        octant = {std::min(a, b), std::max(a, b)};
      }
      kept.set(i, given[i]);
    }
    std::vector<ValueRange> ranges;  // of each macrocell, then of its octants
    kept.mark(Recorder{ranges, false});
    ASSERT_EQ(ranges.size(), kCount * (1 + kOctants));
    for (std::size_t i = 0; i < kCount; ++i) {
      const ValueRange& whole = ranges[i * (1 + kOctants)];
      // The last of the 15 steps is the longest; two roundings of values up to 1.
      const float longest = 29.0f / 225.0f * (whole.highest - whole.lowest) + 0x1p-22f;
      for (std::size_t k = 0; k < kOctants; ++k) {
        const ValueRange& octant = ranges[i * (1 + kOctants) + 1 + k];
        EXPECT_LE(octant.lowest, given[i][k].lowest);
        EXPECT_GE(octant.highest, given[i][k].highest);
        EXPECT_LE(given[i][k].lowest - octant.lowest, longest);
        EXPECT_LE(octant.highest - given[i][k].highest, longest);
        EXPECT_GE(octant.lowest, whole.lowest);
        EXPECT_LE(octant.highest, whole.highest);
      }
    }
  }
}

TEST(Macrocells, SlabsInAnyCutGiveTheSameRanges) {
  const Values values = randomValues({{2, 1, 3}, {27, 22, 25}}, 11);
  const Macrocells whole = macrocellsOf(values);
  Macrocells cut{values.box, false};
  const std::size_t slice = values.stored.size() / 22;
  for (int z = 3; z < 25; z += 3) {
    const IndexBox slab{{2, 1, z}, {27, 22, std::min(z + 3, 25)}};
    cut.add(slab, std::span{values.stored}.subspan(static_cast<std::size_t>(z - 3) * slice,
                                                   slab.count()));
  }
  cut.finish();
  std::vector<ValueRange> ofWhole, ofCut;
  whole.mark(Recorder{ofWhole, false});
  cut.mark(Recorder{ofCut, false});
  ASSERT_EQ(ofWhole.size(), ofCut.size());
  for (std::size_t i = 0; i < ofWhole.size(); ++i) {
    EXPECT_EQ(ofWhole[i].lowest, ofCut[i].lowest);
    EXPECT_EQ(ofWhole[i].highest, ofCut[i].highest);
  }
}

TEST(Macrocells, NanIsNothing) {
  const IndexBox box{{0, 0, 0}, {9, 9, 9}};
  Macrocells cells{box, false};
  cells.add(box, std::vector<float>(box.count(), std::nanf("")));
  cells.finish();
  const std::vector<OctantMask> marks = cells.mark(Above{-1});
  EXPECT_THAT(marks, testing::Each(0));
  EXPECT_TRUE(cells.boxOf(marks).empty());
}

}  // namespace
}  // namespace burin::node
