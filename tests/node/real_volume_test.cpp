// Real volumes, where the environment's BURIN_TEST_DATA names a folder of them: their sizes, types
// and value ranges as other programs (Teem, NumPy) found them.
#include <gtest/gtest.h>

#include <cstdlib>

#include "burin/node/survey.hpp"
#include "support/mpi_test.hpp"
#include "volume_files.hpp"

namespace burin::test {
namespace {

struct Known {
  const char* file;
  glm::ivec3 dims;
  node::VoxelType type;
  glm::dvec3 spacing;
  double lowest;
  double highest;
};

const Known kKnown[] = {
    {"fuel_64x64x64_uint8.nrrd", {64, 64, 64}, node::VoxelType::kU8, {1, 1, 1}, 0, 255},
    {"nucleon_41x41x41_uint8.nrrd", {41, 41, 41}, node::VoxelType::kU8, {1, 1, 1}, 0, 249},
    {"statue-leg_341x341x93_uint8.nrrd", {341, 341, 93}, node::VoxelType::kU8, {1, 1, 4}, 0, 250},
    {"ctcranium_256x256x108_int16.nrrd",
     {256, 256, 108},
     node::VoxelType::kI16,
     {0.9570312, 0.9570312, 1.5},
     -1024,
     2986},
    {"headsq_64x64x93_uint16.nrrd", {64, 64, 93}, node::VoxelType::kU16, {3.2, 3.2, 1.5}, 0, 3926},
    {"inia19-mri_168x206x128_float32.nrrd",
     {168, 206, 128},
     node::VoxelType::kF32,
     {0.5, 0.5, 0.5},
     0,
     383.176}};

TEST(RealVolume, HasTheKnownRange) {
  const char* folder = std::getenv("BURIN_TEST_DATA");
  if (folder == nullptr || !std::filesystem::is_directory(folder)) {
    GTEST_SKIP() << "BURIN_TEST_DATA names no folder of volumes";
  }
  int found = 0;
  for (const Known& known : kKnown) {
    const auto file = std::filesystem::path{folder} / known.file;
    if (!std::filesystem::exists(file)) continue;
    ++found;
    SCOPED_TRACE(known.file);
    const auto source = node::openVolume(fileChoice(file.string()));
    EXPECT_EQ(source->info().grid.dims, known.dims);
    EXPECT_EQ(source->info().type, known.type);
    EXPECT_EQ(source->info().grid.spacing, known.spacing);
    const auto survey = node::surveyVolume(world(), *source, {});
    // The table gives six digits.
    EXPECT_NEAR(survey.lowest, known.lowest, 5e-7 * std::abs(known.lowest));
    EXPECT_NEAR(survey.highest, known.highest, 5e-6 * std::abs(known.highest));
    EXPECT_EQ(survey.nanCount + survey.infiniteCount, 0);
  }
  if (found == 0) GTEST_SKIP() << folder << " holds none of the known volumes";
}

}  // namespace
}  // namespace burin::test
