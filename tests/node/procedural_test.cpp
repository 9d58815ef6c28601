// Procedural volumes against formulas written down independently.
#include "burin/node/procedural.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "volume_files.hpp"

namespace burin::test {
namespace {

using node::VoxelType;
using std::numbers::pi;

double valueOf(std::string_view kind, const glm::dvec3& p) {
  for (const node::ProceduralKind& candidate : node::proceduralKinds()) {
    if (candidate.name == kind) return candidate.value(p);
  }
  throw std::runtime_error{"no such kind"};
}

std::vector<glm::dvec3> randomPoints(std::size_t count) {
  std::mt19937 random{3};
  const auto uniform = [&] { return static_cast<double>(random()) * 0x1p-32; };
  std::vector<glm::dvec3> points;
  while (points.size() < count) points.emplace_back(uniform(), uniform(), uniform());
  return points;
}

// Formulas of a few operations on numbers of order one, in double; arguments of sines up to 40.
constexpr double kTolerance = 1e-13;

TEST(Procedural, AllKindsStayInRange) {
  for (const node::ProceduralKind& kind : node::proceduralKinds()) {
    for (const glm::dvec3& p : randomPoints(20000)) {
      const double value = kind.value(p);
      ASSERT_GE(value, 0) << kind.name;
      ASSERT_LE(value, 1) << kind.name;
    }
    for (int corner = 0; corner < 8; ++corner) {
      const double value = kind.value({corner & 1, (corner >> 1) & 1, corner >> 2});
      ASSERT_TRUE(value >= 0 && value <= 1) << kind.name;
    }
  }
}

TEST(Procedural, MarschnerLobb) {
  for (const glm::dvec3& p : randomPoints(1000)) {
    const double x = 2 * p.x - 1, y = 2 * p.y - 1, z = 2 * p.z - 1;
    const double rho = std::cos(12 * pi * std::cos(pi / 2 * std::sqrt(x * x + y * y)));
    EXPECT_NEAR(valueOf("marschner-lobb", p), (1 - std::sin(pi / 2 * z) + 0.25 * (1 + rho)) / 2.5,
                kTolerance);
  }
}

TEST(Procedural, Shells) {
  for (const glm::dvec3& p : randomPoints(1000)) {
    const double r2 = 4 * glm::dot(p - 0.5, p - 0.5);
    // sin⁴x = (3 - 4 cos 2x + cos 4x) / 8
    const double x = 4 * pi * std::sqrt(r2);
    const double wave = (3 - 4 * std::cos(2 * x) + std::cos(4 * x)) / 8;
    EXPECT_NEAR(valueOf("shells", p), r2 < 1 ? wave * (1 - 0.6 * r2) : 0, kTolerance);
  }
}

TEST(Procedural, RampAndHomogeneous) {
  for (const glm::dvec3& p : randomPoints(100)) {
    EXPECT_EQ(valueOf("ramp", p), p.x);
    EXPECT_EQ(valueOf("homogeneous", p), 0.5);
  }
}

/// Half the field of an endless straight tube at `ratio` radii from its centre line, through the
/// wall's quintic from 0.02 to 0.75: what the trunk is where it starts, on the bottom face.
double trunkFoot(double ratio) {
  const double field = 0.5 * std::pow(1 - ratio * ratio, 2.5);
  const double t = (field - 0.02) / 0.73;
  if (t <= 0) return 0;
  return 6 * std::pow(t, 5) - 15 * std::pow(t, 4) + 10 * std::pow(t, 3);
}

TEST(Procedural, VesselTrunkHasTheTubeProfile) {
  constexpr double kTrunkRadius = 0.055;
  // The trunk bends from its second segment on: within 0.3 radian by the end of the kernel, which
  // moves the centre line by less than 0.1 radius and the value by 0.1 times its steepest slope, 2.
  for (const double ratio : {0.0, 0.2, 0.4, 0.6}) {
    EXPECT_NEAR(valueOf("vessels", {0.5 + ratio * kTrunkRadius, 0, 0.5}), trunkFoot(ratio), 0.2);
    EXPECT_NEAR(valueOf("vessels", {0.5, 0, 0.5 - ratio * kTrunkRadius}), trunkFoot(ratio), 0.2);
  }
  EXPECT_EQ(valueOf("vessels", {0.5 + 1.01 * kTrunkRadius, 0, 0.5}), 0);
}

TEST(Procedural, VesselsAreContinuousAcrossLookUpCells) {
  // The field's gradient is at most 2.5/R per tube (R >= 0.0095) and three tubes meet in a fork;
  // the wall's quintic steepens it by 1.875/0.73. Over 2e-9 that is 4e-6. A segment missing from
  // one cell's list would show as a jump far above.
  constexpr double kSmall = 1e-9;
  constexpr double kBound = 4e-6;
  int inside = 0;
  for (glm::dvec3 p : randomPoints(300000)) {
    const int axis = static_cast<int>(p.x * 3e6) % 3;
    p[axis] = std::round(p[axis] * 64) / 64;
    glm::dvec3 a = p, b = p;
    a[axis] -= kSmall;
    b[axis] += kSmall;
    const double value = valueOf("vessels", a);
    inside += value > 0.1 && value < 0.9 ? 1 : 0;
    ASSERT_NEAR(value, valueOf("vessels", b), kBound) << p.x << " " << p.y << " " << p.z;
  }
  EXPECT_GT(inside, 500);  // the points did meet walls
}

TEST(Procedural, PhantomHasATissuesNumbers) {
  // i16 stores Hounsfield units rounded; the points lie well inside their tissue.
  const auto at = [](double x, double y, double z) {
    return std::lround(valueOf("ct-phantom", {x, y, z}) * 4095 - 1024);
  };
  EXPECT_EQ(at(0, 0.9, 0.1), -1000);              // air
  EXPECT_EQ(at(0.40, 0.52, 0.47), 35);            // brain
  EXPECT_EQ(at(0.37, 0.70, 0.55), 180);           // lesion
  EXPECT_EQ(at(0.54, 0.67, 0.50), 5);             // ventricle
  EXPECT_EQ(at(0.46, 0.67, 0.50), 5);             // and its mirror image
  EXPECT_EQ(at(0.5, 0.615 + 0.284, 0.47), 1100);  // skull
  EXPECT_EQ(at(0.605, 0.5, 0.795), 15);           // eye
}

TEST(Procedural, TheHeadSaysHowItStands) {
  for (const char* kind : {"ct-phantom", "ct-phantom-labels"}) {
    const auto source = node::makeProcedural(kind, {41, 41, 41}, VoxelType::kU8, glm::dvec3{2});
    EXPECT_TRUE(source->info().anatomical);
    const VolumeGrid& grid = source->info().grid;
    const auto fromCentre = [&](const glm::dvec3& p) {
      return grid.worldFromIndex(40.0 * p) - grid.centreWorld();
    };
    // Left, posterior, superior: the crown is above, the eyes are in front.
    EXPECT_NEAR(glm::length(fromCentre({0.5, 1, 0.5}) - glm::dvec3{0, 0, 40}), 0, 1e-12);
    EXPECT_LT(fromCentre({0.605, 0.5, 0.795}).y, -20);
  }
}

TEST(Procedural, HomogeneousVoxelsHaveOneValue) {
  const auto u8 = node::makeProcedural("homogeneous", {9, 8, 7}, VoxelType::kU8, glm::dvec3{1});
  const auto voxels = loadedWhole<std::uint8_t>(*u8);
  EXPECT_EQ(std::set<std::uint8_t>(voxels.begin(), voxels.end()), (std::set<std::uint8_t>{128}));
  const auto f32 = node::makeProcedural("homogeneous", {9, 8, 7}, VoxelType::kF32, glm::dvec3{1});
  const auto floats = loadedWhole<float>(*f32);
  EXPECT_EQ(std::set<float>(floats.begin(), floats.end()), (std::set<float>{0.5f}));
}

TEST(Procedural, TypesStoreTheStatedScale) {
  const glm::ivec3 dims{5, 1, 2};
  const auto ramp = [&](VoxelType type) {
    return node::makeProcedural("ramp", dims, type, {1, 2, 3});
  };
  const auto u8 = ramp(VoxelType::kU8);
  EXPECT_EQ(u8->info().grid.spacing, glm::dvec3(1, 2, 3));
  EXPECT_EQ(u8->info().name, "procedural ramp");
  EXPECT_FALSE(u8->info().anatomical);
  EXPECT_EQ(loaded<std::uint8_t>(*u8, {{0, 0, 1}, {5, 1, 2}}),
            (std::vector<std::uint8_t>{0, 64, 128, 191, 255}));
  EXPECT_EQ(loaded<std::uint16_t>(*ramp(VoxelType::kU16), {{0, 0, 0}, {5, 1, 1}}),
            (std::vector<std::uint16_t>{0, 1024, 2048, 3071, 4095}));
  EXPECT_EQ(loaded<std::int16_t>(*ramp(VoxelType::kI16), {{0, 0, 0}, {5, 1, 1}}),
            (std::vector<std::int16_t>{-1024, 0, 1024, 2047, 3071}));
  EXPECT_EQ(loaded<float>(*ramp(VoxelType::kF32), {{0, 0, 0}, {5, 1, 1}}),
            (std::vector<float>{0, 0.25f, 0.5f, 0.75f, 1}));
}

TEST(Procedural, RegionsAreTheValuesAtTheirVoxels) {
  const glm::ivec3 dims{9, 6, 5};
  for (const node::ProceduralKind& kind : node::proceduralKinds()) {
    if (kind.isLabels) continue;  // not of that type
    const auto source = node::makeProcedural(kind.name, dims, VoxelType::kF32, glm::dvec3{1});
    std::vector<float> expected;
    for (int k = 0; k < 5; ++k)
      for (int j = 0; j < 6; ++j)
        for (int i = 0; i < 9; ++i)
          expected.push_back(static_cast<float>(kind.value({i / 8.0, j / 5.0, k / 4.0})));
    EXPECT_EQ(loadedWhole<float>(*source), expected) << kind.name;
    const IndexBox part{{2, 1, 3}, {8, 5, 5}};
    EXPECT_EQ(loaded<float>(*source, part), picked(expected, dims, part)) << kind.name;
  }
  // An axis of one voxel lies in the middle.
  const auto thin = node::makeProcedural("ramp", {1, 1, 1}, VoxelType::kF32, glm::dvec3{1});
  EXPECT_EQ(loadedWhole<float>(*thin), std::vector<float>{0.5f});
}

}  // namespace
}  // namespace burin::test
