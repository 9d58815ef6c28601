// Volumes that other programs wrote (write_volumes.py): the voxels are theirs bit for bit, after
// the conversion that NumPy makes of them, and lie where they say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "volume_files.hpp"
#include "voxel_access.hpp"
#include "written_volumes.hpp"

namespace burin::test {
namespace {

/// Spacing, origin and directions as the writer was told. Text formats have six digits or more,
/// NIfTI and TIFF single precision.
void expectGeometry(const node::VolumeInfo& info, const WrittenVolume& one) {
  const auto place = placeOf(one);
  if (!place) return;
  EXPECT_EQ(info.anatomical, place->anatomical);
  constexpr double kGeometryTolerance = 1e-5;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(info.grid.spacing[axis], place->grid.spacing[axis], kGeometryTolerance) << axis;
    EXPECT_NEAR(info.grid.origin[axis], place->grid.origin[axis], kGeometryTolerance) << axis;
    EXPECT_LE(glm::distance(info.grid.direction[axis], place->grid.direction[axis]),
              kGeometryTolerance)
        << axis;
  }
}

std::string bytesOf(node::BrickSource& source, const IndexBox& box) {
  std::string bytes(box.count() * node::bytesPerVoxel(source.info().type), '\0');
  source.load(box, std::as_writable_bytes(std::span{bytes}));
  return bytes;
}

/// The box's voxels out of those of the whole volume.
std::string pickedBytes(const std::string& all, const glm::ivec3& dims, const IndexBox& box,
                        std::size_t bytesPerVoxel) {
  std::string bytes(box.count() * bytesPerVoxel, '\0');
  node::copyVoxels(std::as_bytes(std::span{all}), {glm::ivec3{0}, dims},
                   std::as_writable_bytes(std::span{bytes}), box, box, bytesPerVoxel);
  return bytes;
}

void expectCase(const WrittenVolume& one) {
  SCOPED_TRACE(fmt::format("{} {}", one.file, one.option));
  const auto source = node::openVolume(choiceOf(one));
  const node::VolumeInfo& info = source->info();
  EXPECT_EQ(node::voxelTypeName(info.type), one.type);
  ASSERT_EQ(info.grid.dims, one.dims);
  expectGeometry(info, one);
  const std::string expected = contentOf(written().folder.path() / one.expected);
  ASSERT_EQ(expected.size(), info.bytes());
  EXPECT_EQ(bytesOf(*source, {glm::ivec3{0}, one.dims}), expected);
  // As bricks do: parts, and slabs in ascending z after others were read.
  const std::size_t each = node::bytesPerVoxel(info.type);
  for (const IndexBox& box :
       {IndexBox{{2, 1, 3}, {6, 4, 5}}, {{0, 0, 1}, {7, 5, 2}}, {{6, 4, 5}, {7, 5, 6}}}) {
    EXPECT_EQ(bytesOf(*source, box), pickedBytes(expected, one.dims, box, each));
  }
}

class ForeignVolumes : public testing::TestWithParam<const char*> {};

// By the beginnings of the files' names, which say who wrote them.
INSTANTIATE_TEST_SUITE_P(Writers, ForeignVolumes,
                         testing::Values("unu", "vtk", "png", "tifffile", "imagej", "tiled", "rgb",
                                         "many.h5", "one.h5", "dicom"),
                         [](const auto& writer) {
                           std::string name = writer.param;
                           std::erase(name, '.');
                           return name;
                         });

TEST_P(ForeignVolumes, AreReadBitForBit) {
  ASSERT_TRUE(written().isThere) << contentOf(written().folder.path() / "log.txt");
  int seen = 0;
  for (const WrittenVolume& one : written().cases) {
    if (!one.file.starts_with(GetParam())) continue;
    expectCase(one);
    ++seen;
  }
  if (seen == 0) skipIfWritersAreMissing();
}

/// The whole volume as floats.
std::vector<float> valuesOf(node::BrickSource& source) {
  const std::string bytes = bytesOf(source, {glm::ivec3{0}, source.info().grid.dims});
  std::vector<float> values(source.info().grid.voxelCount());
  node::widenToFloat(source.info().type, std::as_bytes(std::span{bytes}), values);
  return values;
}

// Keys that another program wrote, as 3D Slicer names its segments.
TEST(SegmentedVolumes, SayTheirSegments) {
  const LabelInfo liver{5, "liver", Colour{221, 130, 101}, 0};
  const LabelInfo kidney{2, "left \"kidney\"", Colour{128, 255, 0}, 1};
  for (const char* file : {"unu_one.seg.nrrd", "unu_two.seg.nrrd"}) {
    if (!std::filesystem::exists(written().folder / file)) return skipIfWritersAreMissing();
    VolumeChoice choice = fileChoice(written().folder / file);
    choice.component = 0;
    EXPECT_THAT(node::openVolume(choice)->info().labels, testing::ElementsAre(liver, kidney));
  }
}

// A converter may turn the order of rows and slices over; in the world all stays where it is.
TEST(ConvertedDicom, StandsInTheSamePlace) {
  std::istringstream lines{contentOf(written().folder.path() / "pairs.txt")};
  int seen = 0;
  for (std::string line; std::getline(lines, line); ++seen) {
    SCOPED_TRACE(line);
    const std::size_t tab = line.find('\t');
    const auto dicom = node::openVolume(fileChoice(written().folder / line.substr(0, tab).c_str()));
    const auto nifti =
        node::openVolume(fileChoice(written().folder / line.substr(tab + 1).c_str()));
    EXPECT_TRUE(dicom->info().anatomical && nifti->info().anatomical);
    const VolumeGrid& from = dicom->info().grid;
    const VolumeGrid& to = nifti->info().grid;
    const auto values = valuesOf(*dicom);
    const auto converted = valuesOf(*nifti);
    ASSERT_EQ(values.size(), converted.size());
    std::size_t at = 0;
    for (int k = 0; k < from.dims.z; ++k)
      for (int j = 0; j < from.dims.y; ++j)
        for (int i = 0; i < from.dims.x; ++i, ++at) {
          const glm::dvec3 index = to.indexFromWorld(from.worldFromIndex(glm::dvec3{i, j, k}));
          const glm::ivec3 voxel{glm::round(index)};
          ASSERT_LE(glm::distance(index, glm::dvec3{voxel}),
                    1e-4);  // single precision in the header
          ASSERT_TRUE((IndexBox{glm::ivec3{0}, to.dims}.contains({voxel, voxel + 1})));
          const int there = (voxel.z * to.dims.y + voxel.y) * to.dims.x + voxel.x;
          ASSERT_EQ(values[at], converted[static_cast<std::size_t>(there)]);
        }
  }
  if (seen == 0) skipIfWritersAreMissing();
}

/// What comes of opening a file and loading all of it.
Error errorOf(const std::string& file) {
  try {
    const auto source = node::openVolume(fileChoice(file));
    bytesOf(*source, {glm::ivec3{0}, source->info().grid.dims});
  } catch (const Error& error) {
    return error;
  }
  return Error{ExitCode::kDone, "nothing failed"};
}

// Their libraries may have opinions of their own; nobody is to hear them.
TEST(BrokenVolumes, AreRefusedInOneLine) {
  testing::internal::CaptureStderr();
  std::istringstream lines{contentOf(written().folder.path() / "refused.txt")};
  int seen = 0;
  for (std::string line; std::getline(lines, line); ++seen) {
    std::istringstream fields{line};
    std::string file;
    std::getline(fields, file, '\t');
    SCOPED_TRACE(file);
    const Error error = errorOf(written().folder / file.c_str());
    EXPECT_EQ(error.code(), ExitCode::kVolume) << error.what();
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
    EXPECT_THAT(error.what(), testing::HasSubstr(written().folder.path().string()));
    for (std::string part; std::getline(fields, part, '\t');)
      EXPECT_THAT(error.what(), testing::HasSubstr(part));
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  if (seen == 0) skipIfWritersAreMissing();
}

}  // namespace
}  // namespace burin::test
