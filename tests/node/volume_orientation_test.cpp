// Where voxels lie in the world: NRRD spaces, NIfTI's sform and qform, scaled values.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "nifti_bytes.hpp"
#include "volume_files.hpp"

namespace burin::test {
namespace {

const std::string kEightVoxels = "\1\2\3\4\5\6\7\10";

class NrrdOrientation : public testing::Test {
 protected:
  node::VolumeInfo open(std::string_view fields) {
    return node::openVolume(
               fileChoice(folder_.write(
                   "a.nrrd",
                   fmt::format("NRRD0005\ntype: uint8\ndimension: 3\n{}encoding: raw\n\n{}", fields,
                               kEightVoxels))))
        ->info();
  }

  TemporaryFolder folder_;
};

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  EXPECT_LE(glm::length(a - b), tolerance)
      << fmt::format("({}, {}, {}) and ({}, {}, {})", a.x, a.y, a.z, b.x, b.y, b.z);
}

// A few roundings of numbers below 10 in double.
constexpr double kDoubleTolerance = 1e-14;

TEST_F(NrrdOrientation, AnatomicalSpacesBecomeLps) {
  struct Case {
    const char* space;
    glm::dvec3 turn;
    bool anatomical;
  };
  const Case cases[] = {{"right-anterior-superior", {-1, -1, 1}, true},
                        {"RAS", {-1, -1, 1}, true},
                        {"left-anterior-superior", {1, -1, 1}, true},
                        {"left-posterior-superior", {1, 1, 1}, true},
                        {"scanner-xyz", {1, 1, 1}, true},
                        {"3D-right-handed", {1, 1, 1}, false}};
  for (const auto& [space, turn, anatomical] : cases) {
    SCOPED_TRACE(space);
    const auto info =
        open(fmt::format("space: {}\nsizes: 2 2 2\nspace directions: (0,3,0) (-2,0,0) (0,0.6,0.8)\n"
                         "space origin: (5,-6,7)\n",
                         space));
    EXPECT_EQ(info.anatomical, anatomical);
    EXPECT_EQ(info.grid.spacing, glm::dvec3(3, 2, 1));
    expectNear(info.grid.origin, turn * glm::dvec3{5, -6, 7}, kDoubleTolerance);
    expectNear(info.grid.worldFromIndex({1, 0, 0}), turn * glm::dvec3{5, -3, 7}, kDoubleTolerance);
    expectNear(info.grid.worldFromIndex({0, 1, 0}), turn * glm::dvec3{3, -6, 7}, kDoubleTolerance);
    expectNear(info.grid.worldFromIndex({0, 0, 1}), turn * glm::dvec3{5, -5.4, 7.8},
               kDoubleTolerance);
  }
}

TEST_F(NrrdOrientation, PlainSpacingsKeepTheFilesAxes) {
  const auto info = open("sizes: 2 2 2\nspacings: 0.5 -2 nan\n");
  EXPECT_FALSE(info.anatomical);
  EXPECT_EQ(info.grid.spacing, glm::dvec3(0.5, 2, 1));
  EXPECT_EQ(info.grid.worldFromIndex({1, 1, 1}), glm::dvec3(0.5, -2, 1));
}

class NiftiOrientation : public testing::Test {
 protected:
  NiftiOrientation() { header_.dim = {3, 2, 2, 2, 1, 1, 1, 1}; }
  std::unique_ptr<node::BrickSource> open() {
    return node::openVolume(
        fileChoice(folder_.write("a.nii", header_.bytes(false) + kEightVoxels)));
  }

  TemporaryFolder folder_;
  NiftiBytes header_;
};

TEST_F(NiftiOrientation, SformIsRas) {
  header_.sformCode = 1;
  header_.qformCode = 1;  // the sform goes first
  header_.srow = {0, -3, 0, 10, 2, 0, 0, 20, 0, 0, 1.5f, 30};
  const auto info = open()->info();
  EXPECT_TRUE(info.anatomical);
  EXPECT_EQ(info.grid.spacing, glm::dvec3(2, 3, 1.5));
  // RAS (10 - 3j, 20 + 2i, 30 + 1.5k), x and y turned: all numbers are exact.
  EXPECT_EQ(info.grid.origin, glm::dvec3(-10, -20, 30));
  EXPECT_EQ(info.grid.worldFromIndex({1, 0, 0}), glm::dvec3(-10, -22, 30));
  EXPECT_EQ(info.grid.worldFromIndex({0, 1, 0}), glm::dvec3(-7, -20, 30));
  EXPECT_EQ(info.grid.worldFromIndex({0, 0, 1}), glm::dvec3(-10, -20, 31.5));
}

TEST_F(NiftiOrientation, QformIsARotationWithAFlip) {
  header_.qformCode = 1;
  // A quarter turn about z, i to y and j to -x; qfac -1 turns k over.
  const float half = std::sqrt(0.5f);
  header_.quaternAndOffset = {0, 0, half, 1, 2, 3};
  header_.pixdim = {-1, 2, 3, 4, 0, 0, 0, 0};
  const auto info = open()->info();
  EXPECT_TRUE(info.anatomical);
  // The quaternion is stored in single precision: 2^-24 relative on numbers up to 7, a few times.
  constexpr double kTolerance = 1e-5;
  expectNear(info.grid.spacing, {2, 3, 4}, kTolerance);
  expectNear(info.grid.origin, {-1, -2, 3}, kTolerance);
  expectNear(info.grid.worldFromIndex({1, 0, 0}), {-1, -4, 3}, kTolerance);
  expectNear(info.grid.worldFromIndex({0, 1, 0}), {2, -2, 3}, kTolerance);
  expectNear(info.grid.worldFromIndex({0, 0, 1}), {-1, -2, -1}, kTolerance);
}

TEST_F(NiftiOrientation, WithoutAFormNothingIsAnatomical) {
  header_.pixdim = {1, 2, 3, 4, 0, 0, 0, 0};
  const auto info = open()->info();
  EXPECT_FALSE(info.anatomical);
  EXPECT_EQ(info.grid.worldFromIndex({1, 1, 1}), glm::dvec3(2, 3, 4));
}

TEST_F(NiftiOrientation, SlopeAndInterceptDeliverFloats) {
  header_.slope = 0.5f;
  header_.intercept = -3;
  const auto source = open();
  EXPECT_EQ(source->info().type, node::VoxelType::kF32);
  EXPECT_EQ(loadedWhole<float>(*source),
            (std::vector<float>{-2.5f, -2, -1.5f, -1, -0.5f, 0, 0.5f, 1}));
  EXPECT_EQ(loaded<float>(*source, {{1, 0, 1}, {2, 2, 2}}), (std::vector<float>{0, 1}));
}

TEST_F(NiftiOrientation, NoScalingKeepsTheType) {
  for (const auto& [slope, intercept] :
       {std::pair{0.0f, 7.0f}, {1.0f, 0.0f}, {std::nanf(""), 0.0f}}) {
    header_.slope = slope;  // 0 says "not set", and then the intercept counts neither
    header_.intercept = intercept;
    EXPECT_EQ(open()->info().type, node::VoxelType::kU8);
  }
}

TEST(Nifti2, IsReadToo) {
  std::string header(544, '\0');
  const auto put = [&](std::size_t at, const auto value) {
    const std::string text = encoded(value, false);
    header.replace(at, text.size(), text);
  };
  put(0, std::int32_t{540});
  header.replace(4, 8, std::string{"n+2\0\r\n\032\n", 8});
  put(12, std::int16_t{512});
  put(14, std::int16_t{16});
  const std::int64_t dims[] = {3, 2, 1, 3, 1, 1, 1, 1};
  for (std::size_t i = 0; i < 8; ++i) put(16 + 8 * i, dims[i]);
  const double spacing[] = {1, 0.1, 0.2, 0.3};
  for (std::size_t i = 0; i < 4; ++i) put(104 + 8 * i, spacing[i]);
  put(168, std::int64_t{544});
  const TemporaryFolder folder;
  const auto voxels = sampleVoxels<std::uint16_t>(6);
  const auto source =
      node::openVolume(fileChoice(folder.write("a.nii", header + encoded(voxels, false))));
  EXPECT_EQ(source->info().grid.dims, glm::ivec3(2, 1, 3));
  EXPECT_EQ(source->info().grid.spacing, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(loadedWhole<std::uint16_t>(*source), voxels);
}

}  // namespace
}  // namespace burin::test
