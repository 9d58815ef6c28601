// The survey on any number of ranks against one pass written down plainly.
#include "burin/node/survey.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "burin/node/procedural.hpp"
#include "support/array_source.hpp"
#include "support/mpi_test.hpp"
#include "volume_files.hpp"

namespace burin::test {
namespace {

using node::BlockRanges;
using node::VolumeSurvey;
using node::VoxelType;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// All voxels as floats, looked at one by one.
struct PlainVolume {
  VolumeGrid grid;
  std::vector<float> values;

  float at(const glm::ivec3& i) const {
    const glm::ivec3 c = glm::clamp(i, glm::ivec3{0}, grid.dims - 1);
    return values[static_cast<std::size_t>(c.x + grid.dims.x * (c.y + grid.dims.y * c.z))];
  }

  template <typename Work>
  void forVoxels(Work&& work) const {
    for (int k = 0; k < grid.dims.z; ++k)
      for (int j = 0; j < grid.dims.y; ++j)
        for (int i = 0; i < grid.dims.x; ++i) work(glm::ivec3{i, j, k});
  }
};

VolumeSurvey plainSurvey(const PlainVolume& volume) {
  VolumeSurvey survey;
  float lowest = kInf, highest = -kInf;
  const int cells = node::blockCellsFor(volume.grid.dims);
  survey.blocks.blockCells = cells;
  survey.blocks.blocks = glm::max((volume.grid.dims + cells - 2) / cells, glm::ivec3{1});
  const auto blocks = survey.blocks.blocks;
  survey.blocks.lowest.assign(static_cast<std::size_t>(blocks.x * blocks.y * blocks.z), kInf);
  survey.blocks.highest.assign(survey.blocks.lowest.size(), -kInf);
  volume.forVoxels([&](const glm::ivec3& i) {
    const float value = volume.at(i);
    survey.nanCount += std::isnan(value) ? 1 : 0;
    survey.infiniteCount += std::isinf(value) ? 1 : 0;
    if (!std::isfinite(value)) return;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
    for (int b = 0; b < blocks.x * blocks.y * blocks.z; ++b) {
      const glm::ivec3 block{b % blocks.x, b / blocks.x % blocks.y, b / (blocks.x * blocks.y)};
      if (glm::any(glm::lessThan(i, block * cells)) ||
          glm::any(glm::greaterThan(i, block * cells + cells)))
        continue;
      auto& blockLowest = survey.blocks.lowest[static_cast<std::size_t>(b)];
      auto& blockHighest = survey.blocks.highest[static_cast<std::size_t>(b)];
      blockLowest = std::min(blockLowest, value);
      blockHighest = std::max(blockHighest, value);
    }
  });
  if (lowest <= highest) {
    survey.lowest = lowest;
    survey.highest = highest;
  }
  return survey;
}

/// |∇f| at every voxel where it is defined, ascending.
std::vector<double> plainMagnitudes(const PlainVolume& volume, const VolumeSurvey& range) {
  const glm::dmat3 toWorld = glm::transpose(glm::inverse(volume.grid.indexToWorld()));
  const auto value = [&](const glm::ivec3& i) {
    const double v = volume.at(i);
    return std::isnan(v) ? v : std::clamp(v, range.lowest, range.highest);
  };
  std::vector<double> magnitudes;
  volume.forVoxels([&](const glm::ivec3& i) {
    glm::dvec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
      glm::ivec3 step{0};
      step[axis] = 1;
      gradient[axis] = (value(i + step) - value(i - step)) / 2;
    }
    const double magnitude = glm::length(toWorld * gradient);
    if (!std::isnan(magnitude) && !std::isnan(volume.at(i))) magnitudes.push_back(magnitude);
  });
  std::ranges::sort(magnitudes);
  return magnitudes;
}

/// A rank's source may be a stream: then the root's voxels are scattered.
class StreamOf : public ArraySource {
 public:
  explicit StreamOf(const ArraySource& source) : ArraySource{source} {}
  bool randomAccess() const override { return false; }
};

PlainVolume plainOf(ArraySource& source) {
  PlainVolume volume{source.info().grid, {}};
  const IndexBox all{glm::ivec3{0}, volume.grid.dims};
  const auto widen = [&](const auto& voxels) {
    for (const auto voxel : voxels) volume.values.push_back(static_cast<float>(voxel));
  };
  switch (source.info().type) {
    case VoxelType::kU8:
      widen(loaded<std::uint8_t>(source, all));
      break;
    case VoxelType::kI16:
      widen(loaded<std::int16_t>(source, all));
      break;
    case VoxelType::kU16:
      widen(loaded<std::uint16_t>(source, all));
      break;
    case VoxelType::kF32:
      widen(loaded<float>(source, all));
  }
  return volume;
}

void expectSameRanges(const VolumeSurvey& a, const VolumeSurvey& b) {
  EXPECT_EQ(a.lowest, b.lowest);
  EXPECT_EQ(a.highest, b.highest);
  EXPECT_EQ(a.nanCount, b.nanCount);
  EXPECT_EQ(a.infiniteCount, b.infiniteCount);
  EXPECT_EQ(a.blocks.blockCells, b.blocks.blockCells);
  EXPECT_EQ(a.blocks.blocks, b.blocks.blocks);
  EXPECT_EQ(a.blocks.lowest, b.blocks.lowest);
  EXPECT_EQ(a.blocks.highest, b.blocks.highest);
}

void expectGradients(const VolumeSurvey& survey, const std::vector<double>& magnitudes) {
  if (magnitudes.empty()) {
    EXPECT_EQ(survey.largestGradient, 0);
    EXPECT_EQ(survey.gradient999, 0);
    return;
  }
  // Both ways: differences of floats are exact to 2^-53 in double, then some ten roundings.
  constexpr double kRelative = 1e-14;
  EXPECT_NEAR(survey.largestGradient, magnitudes.back(), kRelative * magnitudes.back());
  const auto rank =
      static_cast<std::size_t>(std::ceil(0.999 * static_cast<double>(magnitudes.size())));
  const double exact = magnitudes[rank - 1];
  // The upper edge of a bin of relative width 2^-10, in single precision (2^-24).
  EXPECT_GE(survey.gradient999, exact * (1 - 0x1p-23));
  EXPECT_LE(survey.gradient999, exact * (1 + 0x1p-10) * (1 + 0x1p-23));
}

void expectSurvey(const ArraySource& source) {
  ArraySource alone{source};
  StreamOf stream{source};
  const PlainVolume plain = plainOf(alone);
  const VolumeSurvey expected = plainSurvey(plain);
  const auto magnitudes = plainMagnitudes(plain, expected);
  const Communicator self{MPI_COMM_SELF};
  const VolumeSurvey onOneRank = node::surveyVolume(self, alone, true);
  for (ArraySource* kind : {&alone, static_cast<ArraySource*>(&stream)}) {
    const VolumeSurvey survey = node::surveyVolume(world(), *kind, true);
    expectSameRanges(survey, expected);
    expectGradients(survey, magnitudes);
    // The same on any number of ranks, to the last bit.
    EXPECT_EQ(survey.largestGradient, onOneRank.largestGradient);
    EXPECT_EQ(survey.gradient999, onOneRank.gradient999);
    const VolumeSurvey withoutGradients = node::surveyVolume(world(), *kind, false);
    expectSameRanges(withoutGradients, expected);
    EXPECT_EQ(withoutGradients.largestGradient, 0);
    EXPECT_EQ(withoutGradients.gradient999, 0);
  }
}

VolumeGrid gridOf(const glm::ivec3& dims) {
  VolumeGrid grid;
  grid.dims = dims;
  grid.spacing = {0.5, 2, 1.25};
  return grid;
}

/// Pseudo-random numbers in [0, 2^32) by voxel, the same on every rank.
std::uint32_t hashOf(const glm::ivec3& i) {
  std::mt19937 random{static_cast<unsigned>(i.x + 1000 * i.y + 1000000 * i.z)};
  return static_cast<std::uint32_t>(random());
}

float randomFloat(const glm::ivec3& i) {
  return static_cast<float>(hashOf(i)) * 1e-6f - 2000;
}

TEST(Survey, EveryType) {
  // 33 and 17 voxels end on a block's border, 34 one cell behind it.
  const VolumeGrid grid = gridOf({34, 33, 17});
  expectSurvey(ArraySource::of<std::uint8_t>(grid, VoxelType::kU8, [](glm::ivec3 i) {
    return static_cast<std::uint8_t>(hashOf(i) >> 24);
  }));
  expectSurvey(ArraySource::of<std::int16_t>(grid, VoxelType::kI16, [](glm::ivec3 i) {
    return static_cast<std::int16_t>(hashOf(i) >> 16);
  }));
  expectSurvey(ArraySource::of<std::uint16_t>(grid, VoxelType::kU16, [](glm::ivec3 i) {
    return static_cast<std::uint16_t>(hashOf(i) >> 16);
  }));
  expectSurvey({grid, randomFloat});
}

TEST(Survey, BlocksAreAsFineAsTheirNumberAllows) {
  EXPECT_EQ(node::blockCellsFor({1, 1, 1}), 4);
  EXPECT_EQ(node::blockCellsFor({256, 256, 256}), 4);
  EXPECT_EQ(node::blockCellsFor({512, 512, 512}), 8);
  EXPECT_EQ(node::blockCellsFor({1024, 1024, 1024}), 16);
  EXPECT_EQ(node::blockCellsFor({4000, 4000, 4000}), 16);
}

TEST(Survey, CoarserBlocks) {
  // So flat and wide that blocks of 4 cells would be too many.
  const VolumeGrid grid = gridOf({2903, 2, 2899});
  auto source = ArraySource::of<std::uint8_t>(grid, VoxelType::kU8, [](glm::ivec3 i) {
    return static_cast<std::uint8_t>((i.x * 7 + i.y * 131 + i.z * 13) * (i.x ^ i.z) >> 3);
  });
  const BlockRanges blocks = surveyVolume(world(), source, false).blocks;
  ASSERT_EQ(blocks.blockCells, 8);
  ASSERT_EQ(blocks.blocks, (glm::ivec3{363, 1, 363}));
  std::vector<std::byte> voxels(grid.voxelCount());
  source.load({glm::ivec3{0}, grid.dims}, voxels);
  int wrong = 0;
  for (int bz = 0; bz < 363; ++bz)
    for (int bx = 0; bx < 363; ++bx) {
      int lowest = 255, highest = 0;
      for (int z = 8 * bz; z <= std::min(8 * bz + 8, 2898); ++z)
        for (int y = 0; y < 2; ++y)
          for (int x = 8 * bx; x <= std::min(8 * bx + 8, 2902); ++x) {
            const int voxel = static_cast<int>(
                voxels[(static_cast<std::size_t>(z) * 2 + static_cast<std::size_t>(y)) * 2903 +
                       static_cast<std::size_t>(x)]);
            lowest = std::min(lowest, voxel);
            highest = std::max(highest, voxel);
          }
      const std::size_t i = blocks.index({bx, 0, bz});
      wrong += blocks.lowest[i] == static_cast<float>(lowest) &&
                       blocks.highest[i] == static_cast<float>(highest)
                   ? 0
                   : 1;
    }
  EXPECT_EQ(wrong, 0);
}

TEST(Survey, ThinVolumes) {
  for (const glm::ivec3& dims :
       {glm::ivec3{1, 1, 1}, {1, 20, 3}, {20, 1, 1}, {2, 2, 40}, {3, 1, 2}}) {
    expectSurvey({gridOf(dims), randomFloat});
  }
}

TEST(Survey, ShearedAxes) {
  VolumeGrid grid = gridOf({12, 11, 10});
  grid.direction = {glm::normalize(glm::dvec3{1, 0.3, 0}), glm::normalize(glm::dvec3{-0.2, 1, 0.4}),
                    glm::normalize(glm::dvec3{0.1, 0, -1})};
  expectSurvey({grid, randomFloat});
}

TEST(Survey, NanAndInfinity) {
  expectSurvey({gridOf({20, 19, 18}), [](glm::ivec3 i) {
                  const std::uint32_t dice = hashOf(i + 7) % 50;
                  return dice == 0 ? kNan : dice == 1 ? kInf : dice == 2 ? -kInf : randomFloat(i);
                }});
  expectSurvey({gridOf({5, 4, 3}), [](glm::ivec3) { return kNan; }});
  expectSurvey({gridOf({5, 4, 3}), [](glm::ivec3) { return -kInf; }});
}

TEST(Survey, ExtremeScales) {
  for (const float scale : {1e-20f, 1e20f, 1e35f}) {
    expectSurvey({gridOf({9, 8, 7}),
                  [&](glm::ivec3 i) { return static_cast<float>(hashOf(i)) * 0x1p-32f * scale; }});
  }
}

TEST(Survey, ALinearFieldHasOneGradient) {
  // f = 3x + 4y + 12z in world units: |∇f| = 13 but at the border, where clamping halves a term.
  const VolumeGrid grid = gridOf({40, 30, 20});
  ArraySource source{grid, [&](glm::ivec3 i) {
                       const glm::dvec3 p = grid.worldFromIndex(glm::dvec3{i});
                       return static_cast<float>(3 * p.x + 4 * p.y + 12 * p.z);
                     }};
  const auto survey = node::surveyVolume(world(), source, true);
  // The values are multiples of 1/2, exact in float; 1/1.25 is not: a few roundings in double.
  EXPECT_NEAR(survey.largestGradient, 13, 13 * 0x1p-50);
  EXPECT_GE(survey.gradient999, 13);
  EXPECT_LE(survey.gradient999, 13 * (1 + 0x1p-10));
}

TEST(Survey, AHomogeneousVolumeHasNoGradient) {
  const auto source =
      node::makeProcedural("homogeneous", {40, 33, 20}, VoxelType::kU8, glm::dvec3{1});
  const auto survey = node::surveyVolume(world(), *source, true);
  EXPECT_EQ(survey.lowest, 128);
  EXPECT_EQ(survey.highest, 128);
  EXPECT_EQ(survey.largestGradient, 0);
  EXPECT_EQ(survey.gradient999, 0);
}

/// A source that cannot read a slice.
class FailingSource : public ArraySource {
 public:
  FailingSource() : ArraySource{gridOf({4, 4, 12}), randomFloat} {}
  void load(const IndexBox& region, std::span<std::byte> out) override {
    if (region.hi.z > 11) fail(ExitCode::kVolume, "the last slice is missing");
    ArraySource::load(region, out);
  }
};

TEST(Survey, AFailureEndsOnAllRanks) {
  FailingSource source;
  try {
    node::surveyVolume(world(), source, true);
    FAIL() << "nothing thrown";
  } catch (const CollectiveError& error) {
    EXPECT_EQ(error.code(), ExitCode::kVolume);
    EXPECT_EQ(error.culprit(), Rank{world().size() - 1});
  }
}

}  // namespace
}  // namespace burin::test
