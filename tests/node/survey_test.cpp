// The survey on any number of ranks against one pass written down plainly.
#include "burin/node/survey.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
    forVoxels({glm::ivec3{0}, grid.dims}, work);
  }

  template <typename Work>
  static void forVoxels(const IndexBox& box, Work&& work) {
    for (int k = box.lo.z; k < box.hi.z; ++k)
      for (int j = box.lo.y; j < box.hi.y; ++j)
        for (int i = box.lo.x; i < box.hi.x; ++i) work(glm::ivec3{i, j, k});
  }
};

/// The ends of a range while values come in; NaN and infinite ones do not count.
struct Ends {
  float lowest = kInf, highest = -kInf;

  void add(float value) {
    if (!std::isfinite(value)) return;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
};

VolumeSurvey plainSurvey(const PlainVolume& volume) {
  VolumeSurvey survey;
  Ends whole;
  volume.forVoxels([&](const glm::ivec3& i) {
    const float value = volume.at(i);
    survey.nanCount += std::isnan(value) ? 1 : 0;
    survey.infiniteCount += std::isinf(value) ? 1 : 0;
    whole.add(value);
  });
  if (whole.lowest <= whole.highest) {
    survey.lowest = whole.lowest;
    survey.highest = whole.highest;
  }
  const glm::ivec3& dims = volume.grid.dims;
  const int cells = node::blockCellsFor(dims);
  survey.blocks.blockCells = cells;
  survey.blocks.blocks = glm::max((dims + cells - 2) / cells, glm::ivec3{1});
  PlainVolume::forVoxels({glm::ivec3{0}, survey.blocks.blocks}, [&](const glm::ivec3& block) {
    Ends ends;
    // Neighbouring blocks share the voxels between them.
    const IndexBox voxels{block * cells, glm::min(block * cells + cells + 1, dims)};
    PlainVolume::forVoxels(voxels, [&](const glm::ivec3& i) { ends.add(volume.at(i)); });
    survey.blocks.lowest.push_back(ends.lowest);
    survey.blocks.highest.push_back(ends.highest);
  });
  return survey;
}

/// Of a value at that offset, in a fit of a linear function by weighted least squares.
double weightOf(GradientOperator which, const glm::ivec3& offset) {
  const double distance = glm::length(glm::dvec3{offset});
  if (which == GradientOperator::kCentral) return distance == 1 ? 1 : 0;
  if (which == GradientOperator::kRegression) return 1 / distance;
  return std::exp2(-distance * distance);  // Sobel's 1-2-1 along each axis
}

/// |∇f| at every voxel where it is defined, ascending.
std::vector<double> plainMagnitudes(const PlainVolume& volume, const VolumeSurvey& range,
                                    GradientOperator which) {
  const glm::dmat3 toWorld = glm::transpose(glm::inverse(volume.grid.indexToWorld()));
  const auto value = [&](const glm::ivec3& i) {
    const double v = volume.at(i);
    return std::isnan(v) ? v : std::clamp(v, range.lowest, range.highest);
  };
  std::vector<double> magnitudes;
  volume.forVoxels([&](const glm::ivec3& i) {
    glm::dvec3 moments{0}, squares{0};
    for (int n = 14; n < 27; ++n) {  // 13 is the middle: half of the offsets, the others opposite
      const glm::ivec3 offset{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
      const double weight = weightOf(which, offset);
      if (weight == 0) continue;
      moments += weight * (value(i + offset) - value(i - offset)) * glm::dvec3{offset};
      squares += 2 * weight * glm::dvec3{offset * offset};
    }
    const double magnitude = glm::length(toWorld * (moments / squares));
    if (!std::isnan(magnitude) && !std::isnan(volume.at(i))) magnitudes.push_back(magnitude);
  });
  std::ranges::sort(magnitudes);
  return magnitudes;
}

/// |∇²(G * f)| at every voxel where it is defined, ascending; G is 1-4-6-4-1 along each axis.
std::vector<double> plainLaplacians(const PlainVolume& volume, const VolumeSurvey& range) {
  constexpr double kSmooth[7] = {0, 1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16, 0};
  // Its first and second central difference.
  constexpr double kDerived[2][7] = {
      {-1.0 / 32, -4.0 / 32, -5.0 / 32, 0, 5.0 / 32, 4.0 / 32, 1.0 / 32},
      {1.0 / 16, 2.0 / 16, -1.0 / 16, -4.0 / 16, -1.0 / 16, 2.0 / 16, 1.0 / 16}};
  const glm::dmat3 toIndex = volume.grid.worldToIndex();
  const glm::dmat3 metric = toIndex * glm::transpose(toIndex);
  const auto tap = [&](int axis, int a, int b, int n) {
    const int order = (axis == a ? 1 : 0) + (axis == b ? 1 : 0);
    return order == 0 ? kSmooth[n] : kDerived[order - 1][n];
  };
  double kernel[7][7][7] = {};
  for (int n = 0; n < 343; ++n)
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        kernel[n / 49][n / 7 % 7][n % 7] +=
            metric[a][b] * tap(0, a, b, n % 7) * tap(1, a, b, n / 7 % 7) * tap(2, a, b, n / 49);
  std::vector<double> magnitudes;
  volume.forVoxels([&](const glm::ivec3& i) {
    double sum = 0;
    for (int n = 0; n < 343; ++n) {
      const double v = volume.at(i + glm::ivec3{n % 7 - 3, n / 7 % 7 - 3, n / 49 - 3});
      sum += kernel[n / 49][n / 7 % 7][n % 7] *
             (std::isnan(v) ? v : std::clamp(v, range.lowest, range.highest));
    }
    if (!std::isnan(sum)) magnitudes.push_back(std::abs(sum));
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

void expectGradients(const node::GradientScales& scales, const std::vector<double>& magnitudes) {
  if (magnitudes.empty()) {
    EXPECT_EQ(scales.maximum, 0);
    EXPECT_EQ(scales.percentile, 0);
    return;
  }
  // Both ways: differences of floats are exact to 2^-53 in double, then some thirty roundings.
  constexpr double kRelative = 1e-14;
  EXPECT_NEAR(scales.maximum, magnitudes.back(), kRelative * magnitudes.back());
  const auto rank =
      static_cast<std::size_t>(std::ceil(0.999 * static_cast<double>(magnitudes.size())));
  const double exact = magnitudes[rank - 1];
  // The upper edge of a bin of relative width 2^-10, in single precision (2^-24).
  EXPECT_GE(scales.percentile, exact * (1 - 0x1p-23));
  EXPECT_LE(scales.percentile, exact * (1 + 0x1p-10) * (1 + 0x1p-23));
}

GradientOperatorSet allOperators() {
  GradientOperatorSet all;
  for (const GradientOperator which : kAllGradientOperators) all.insert(which);
  return all;
}

/// The same on any number of ranks, to the last bit.
void expectSameSurvey(const VolumeSurvey& a, const VolumeSurvey& b) {
  expectSameRanges(a, b);
  for (const GradientOperator which : kAllGradientOperators) {
    EXPECT_EQ(a.gradients[which].maximum, b.gradients[which].maximum);
    EXPECT_EQ(a.gradients[which].percentile, b.gradients[which].percentile);
  }
  EXPECT_EQ(a.laplacian999, b.laplacian999);
}

/// Every rank compares what all have found with one rank's survey; that one is compared with the
/// plain pass, which takes longer than all surveys, on the root alone.
void expectSurvey(const ArraySource& source) {
  ArraySource alone{source};
  StreamOf stream{source};
  const Communicator self{MPI_COMM_SELF};
  const VolumeSurvey onOneRank = node::surveyVolume(self, alone, {allOperators()});
  if (world().isRoot()) {
    const PlainVolume plain = plainOf(alone);
    const VolumeSurvey expected = plainSurvey(plain);
    expectSameRanges(onOneRank, expected);
    for (const GradientOperator which : kAllGradientOperators)
      expectGradients(onOneRank.gradients[which], plainMagnitudes(plain, expected, which));
  }
  for (ArraySource* kind : {&alone, static_cast<ArraySource*>(&stream)}) {
    expectSameSurvey(node::surveyVolume(world(), *kind, {allOperators()}), onOneRank);
    VolumeSurvey withoutGradients = onOneRank;
    withoutGradients.gradients = {};
    expectSameSurvey(node::surveyVolume(world(), *kind, {}), withoutGradients);
  }
}

VolumeGrid gridOf(const glm::ivec3& dims) {
  VolumeGrid grid;
  grid.dims = dims;
  grid.spacing = {0.5, 2, 1.25};
  return grid;
}

/// Pseudo-random numbers in [0, 2^32) by voxel, the same on every rank: the finalizer of
/// MurmurHash3, because seeding a generator for every voxel takes longer than all surveys.
std::uint32_t hashOf(const glm::ivec3& i) {
  auto h = static_cast<std::uint32_t>(i.x + 1000 * i.y + 1000000 * i.z) + 1;
  h = (h ^ h >> 16) * 0x85eb'ca6bu;
  h = (h ^ h >> 13) * 0xc2b2'ae35u;
  return h ^ h >> 16;
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

TEST(Survey, MoreBlocksThanThereIsMemoryForAreRefusedWithNumbers) {
  const auto source =
      node::makeProcedural("ramp", glm::ivec3{300'000}, VoxelType::kU8, glm::dvec3{1});
  try {
    node::surveyVolume(world(), *source, {});
    ADD_FAILURE() << "taken";
  } catch (const CollectiveError& error) {
    EXPECT_NE(std::string_view{error.what()}.find(
                  "the survey of procedural ramp (300000 x 300000 x 300000 voxels) needs"),
              std::string_view::npos)
        << error.what();
  }
}

TEST(Survey, BlocksAreAsFineAsTheirNumberAllows) {
  EXPECT_EQ(node::blockCellsFor({1, 1, 1}), 4);
  EXPECT_EQ(node::blockCellsFor({256, 256, 256}), 4);
  EXPECT_EQ(node::blockCellsFor({512, 512, 512}), 8);
  EXPECT_EQ(node::blockCellsFor({1024, 1024, 1024}), 16);
  EXPECT_EQ(node::blockCellsFor({4000, 4000, 4000}), 16);
}

TEST(Survey, CoarserBlocks) {
  // So long that blocks of 4 cells would be too many.
  const VolumeGrid grid = gridOf({700'004, 1, 10});
  std::vector<std::byte> voxels;
  voxels.reserve(grid.voxelCount());
  for (std::uint32_t i = 0; i < grid.voxelCount(); ++i)  // 2^32 over the golden ratio
    voxels.push_back(static_cast<std::byte>(i * 2654435769u >> 24));
  ArraySource source{{.name = "long", .format = "array", .grid = grid, .type = VoxelType::kU8},
                     voxels};
  const BlockRanges blocks = surveyVolume(world(), source, {}).blocks;
  ASSERT_EQ(blocks.blockCells, 8);
  ASSERT_EQ(blocks.blocks, (glm::ivec3{87'501, 1, 2}));
  int wrong = 0;
  for (int bz = 0; bz < 2; ++bz)
    for (int bx = 0; bx < 87'501; ++bx) {
      std::byte lowest{255}, highest{0};
      for (int z = 8 * bz; z <= std::min(8 * bz + 8, 9); ++z)
        for (int x = 8 * bx; x <= std::min(8 * bx + 8, 700'003); ++x) {
          const std::byte voxel = voxels[static_cast<std::size_t>(700'004 * z + x)];
          lowest = std::min(lowest, voxel);
          highest = std::max(highest, voxel);
        }
      const std::size_t i = blocks.index({bx, 0, bz});
      const bool isRight = blocks.lowest[i] == static_cast<float>(lowest) &&
                           blocks.highest[i] == static_cast<float>(highest);
      wrong += isRight ? 0 : 1;
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
  const auto survey = node::surveyVolume(world(), source, {allOperators()});
  for (const GradientOperator which : kAllGradientOperators) {
    const node::GradientScales& scales = survey.gradients[which];
    // The values are multiples of 1/2, exact in float, 1/1.25 and the weights are not: some thirty
    // roundings in double, and the percentile is a float.
    EXPECT_NEAR(scales.maximum, 13, 13 * 0x1p-48);
    EXPECT_GE(scales.percentile, 13 * (1 - 0x1p-24));
    EXPECT_LE(scales.percentile, 13 * (1 + 0x1p-10));
  }
}

TEST(Survey, AHomogeneousVolumeHasNoGradient) {
  const auto source =
      node::makeProcedural("homogeneous", {40, 33, 20}, VoxelType::kU8, glm::dvec3{1});
  const auto survey = node::surveyVolume(world(), *source, {allOperators()});
  EXPECT_EQ(survey.lowest, 128);
  EXPECT_EQ(survey.highest, 128);
  for (const GradientOperator which : kAllGradientOperators) {
    EXPECT_EQ(survey.gradients[which].maximum, 0);
    EXPECT_EQ(survey.gradients[which].percentile, 0);
  }
}

TEST(Survey, LaplaciansOfEveryRankTogether) {
  VolumeGrid sheared = gridOf({14, 11, 19});
  sheared.direction = {glm::normalize(glm::dvec3{1, 0.3, 0}),
                       glm::normalize(glm::dvec3{-0.2, 1, 0.4}),
                       glm::normalize(glm::dvec3{0.1, 0, -1})};
  const auto withHoles = [](glm::ivec3 i) {
    if (i == glm::ivec3{3, 4, 9}) return kNan;
    return i == glm::ivec3{9, 8, 2} ? kInf : randomFloat(i);
  };
  const ArraySource sources[] = {{gridOf({14, 11, 19}), randomFloat},
                                 {sheared, randomFloat},
                                 {gridOf({14, 11, 19}), withHoles},
                                 {gridOf({2, 1, 3}), randomFloat}};
  const Communicator self{MPI_COMM_SELF};
  for (ArraySource source : sources) {
    const VolumeSurvey survey = node::surveyVolume(world(), source, {{}, true});
    EXPECT_EQ(survey.laplacian999, node::surveyVolume(self, source, {{}, true}).laplacian999);
    if (!world().isRoot()) continue;
    const PlainVolume plain = plainOf(source);
    const std::vector<double> magnitudes = plainLaplacians(plain, plainSurvey(plain));
    const auto rank =
        static_cast<std::size_t>(std::ceil(0.999 * static_cast<double>(magnitudes.size())));
    // Some sixty roundings of 2^-24 of the values, which are as large as their second differences;
    // the bin is 2^-10 wide.
    EXPECT_GE(survey.laplacian999, magnitudes[rank - 1] * (1 - 64 * 0x1p-24));
    EXPECT_LE(survey.laplacian999, magnitudes[rank - 1] * (1 + 0x1p-10) * (1 + 64 * 0x1p-24));
  }
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
    node::surveyVolume(world(), source, {allOperators()});
    FAIL() << "nothing thrown";
  } catch (const CollectiveError& error) {
    EXPECT_EQ(error.code(), ExitCode::kVolume);
    EXPECT_EQ(error.culprit(), Rank{world().size() - 1});
  }
}

}  // namespace
}  // namespace burin::test
