#include "burin/node/volume_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "burin/common/error.hpp"
#include "burin/node/procedural.hpp"
#include "support/array_source.hpp"
#include "volume_files.hpp"

namespace burin::test {
namespace {

using node::VoxelType;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::byte> allBytes(node::BrickSource& source) {
  std::vector<std::byte> bytes(source.info().bytes());
  source.load({glm::ivec3{0}, source.info().grid.dims}, bytes);
  return bytes;
}

/// A grid that is turned, shifted and anisotropic.
ArraySource orientedSource(bool orthogonal) {
  VolumeGrid grid;
  grid.dims = {4, 3, 5};
  grid.spacing = {0.5, 2, 1.25};
  grid.origin = {-10, 20.5, 3};
  grid.direction = {{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, -1}};
  if (!orthogonal) grid.direction[2] = glm::normalize(glm::dvec3{0.3, 0.1, 1});
  auto source = ArraySource::of<std::int16_t>(grid, VoxelType::kI16, [](glm::ivec3 i) {
    return static_cast<std::int16_t>(i.x - 100 * i.y + 1000 * i.z);
  });
  node::VolumeInfo info = source.info();
  info.anatomical = true;
  return {info, allBytes(source)};
}

class VolumeWriter : public testing::TestWithParam<std::tuple<std::string, bool>> {
 protected:
  std::string extension() const { return std::get<0>(GetParam()); }
  node::WriteOptions options() const {
    node::WriteOptions all;
    all.gzip = std::get<1>(GetParam());
    return all;
  }
  bool isNifti() const { return extension().starts_with(".nii"); }
  bool isRaw() const { return extension().starts_with(".raw"); }

  TemporaryFolder folder_;
};

/// The formats that have a header.
class VolumeWriterHeader : public VolumeWriter {};

constexpr bool kGzip = true;
INSTANTIATE_TEST_SUITE_P(Bare, VolumeWriter,
                         testing::Values(std::tuple{".raw", !kGzip},
                                         std::tuple{".raw.gz", !kGzip}));
const auto kHeaderFormats = testing::Values(
    std::tuple{".nrrd", !kGzip}, std::tuple{".nrrd", kGzip}, std::tuple{".nhdr", !kGzip},
    std::tuple{".nhdr", kGzip}, std::tuple{".nii", !kGzip}, std::tuple{".nii.gz", !kGzip});
INSTANTIATE_TEST_SUITE_P(Headed, VolumeWriter, kHeaderFormats);
INSTANTIATE_TEST_SUITE_P(Headed, VolumeWriterHeader, kHeaderFormats);

TEST_P(VolumeWriter, RoundTripOfEveryType) {
  const glm::ivec3 dims{9, 7, 11};
  for (const VoxelType type : {VoxelType::kU8, VoxelType::kI16, VoxelType::kU16, VoxelType::kF32}) {
    // Powers of two: exact in NIfTI's single precision too.
    const auto source = node::makeProcedural("shells", dims, type, {0.5, 1, 2});
    const auto file = folder_.path() / ("volume" + extension());
    node::writeVolume(*source, file, options());
    VolumeChoice choice = fileChoice(file.string());
    if (isRaw()) {
      choice.dims = dims;
      choice.type = node::voxelTypeName(type);
      choice.spacing = glm::dvec3{0.5, 1, 2};
    }
    const auto read = node::openVolume(choice);
    EXPECT_EQ(read->info().type, type);
    EXPECT_EQ(read->info().grid.dims, dims);
    EXPECT_EQ(read->info().grid.spacing, glm::dvec3(0.5, 1, 2));
    EXPECT_EQ(read->info().grid.origin, glm::dvec3(0));
    EXPECT_EQ(read->info().grid.direction, glm::dmat3(1));
    EXPECT_FALSE(read->info().anatomical);
    EXPECT_EQ(allBytes(*read), allBytes(*source));
    const bool isPacked = options().gzip || extension().ends_with(".gz");
    EXPECT_EQ(read->randomAccess(), !isPacked);
  }
  const std::size_t files = extension() == ".nhdr" ? 2 : 1;
  EXPECT_EQ(folder_.names().size(), files);  // nothing temporary is left
}

TEST_P(VolumeWriterHeader, OrientationIsKept) {
  // NRRD: numbers of up to 20 in double, a handful of roundings. NIfTI: 2^-24 relative.
  const double tolerance = isNifti() ? 1e-5 : 1e-13;
  for (const bool orthogonal : {true, false}) {
    auto source = orientedSource(orthogonal);
    const auto file = folder_.path() / ("volume" + extension());
    node::writeVolume(source, file, options());
    const auto read = node::openVolume(fileChoice(file.string()));
    EXPECT_TRUE(read->info().anatomical);
    for (const glm::dvec3& index : {glm::dvec3{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 4}}) {
      EXPECT_LE(glm::distance(read->info().grid.worldFromIndex(index),
                              source.info().grid.worldFromIndex(index)),
                tolerance);
    }
    EXPECT_EQ(allBytes(*read), allBytes(source));
  }
}

TEST(DetachedNrrd, KeepsVoxelsThatBelongToNothing) {
  const TemporaryFolder folder;
  folder.write("x.raw", "somebody's own");
  const auto source = node::makeProcedural("ramp", {4, 4, 4}, VoxelType::kU8, {1, 1, 1});
  try {
    node::writeVolume(*source, folder / "x.nhdr");
    ADD_FAILURE() << "was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kUsage);
    EXPECT_THAT(error.what(), HasSubstr("x.raw"));
  }
  EXPECT_THAT(folder.names(), ElementsAre("x.raw"));
  EXPECT_EQ(std::filesystem::file_size(folder / "x.raw"), 14U);
}

/// Fails when a slice from z = 2 on is asked for.
class FailingSource : public ArraySource {
 public:
  using ArraySource::ArraySource;
  explicit FailingSource(const ArraySource& source) : ArraySource{source} {}
  void load(const IndexBox& region, std::span<std::byte> out) override {
    if (region.hi.z > 2) fail(ExitCode::kVolume, "slice 2 is unreadable");
    ArraySource::load(region, out);
  }
};

TEST_P(VolumeWriter, AFailureLeavesTheOldFileAlone) {
  const std::string name = "volume" + extension();
  folder_.write(name, "the old file");
  FailingSource source{orientedSource(true)};
  EXPECT_THROW(node::writeVolume(source, folder_.path() / name, options()), Error);
  EXPECT_THAT(folder_.names(), ElementsAre(name));
  EXPECT_EQ(std::filesystem::file_size(folder_.path() / name), 12u);
}

TEST(VolumeWriterErrors, NameWhatIsWrong) {
  const TemporaryFolder folder;
  auto source = orientedSource(true);
  const auto messageOf = [&](const std::filesystem::path& file) -> std::string {
    try {
      node::writeVolume(source, file);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kUsage);
      return error.what();
    }
    return "nothing failed";
  };
  EXPECT_THAT(messageOf(folder.path() / "a.png"), HasSubstr(".nrrd .nhdr .nii"));
  EXPECT_THAT(messageOf(folder.path() / "none" / "a.nrrd"), HasSubstr("No such file"));
  const auto wide = node::makeProcedural("ramp", {40000, 1, 1}, VoxelType::kU8, glm::dvec3{1});
  EXPECT_THROW(node::writeVolume(*wide, folder.path() / "a.nii"), Error);
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(VolumeWriterErrors, ADiskTooSmallIsFoundBeforeWriting) {
  const TemporaryFolder folder;
  // 10^18 bytes
  const auto huge =
      node::makeProcedural("ramp", glm::ivec3{1000000}, VoxelType::kU8, glm::dvec3{1});
  for (const char* name : {"a.nrrd", "a.nhdr", "a.raw"}) {
    try {
      node::writeVolume(*huge, folder / name);
      ADD_FAILURE() << "was written";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kRank);
      EXPECT_THAT(error.what(), HasSubstr("are to be written, the disk has"));
    }
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(VolumeWriterProgress, EndsAtOneAndMayStopTheWriting) {
  const TemporaryFolder folder;
  // Two slabs of 32 MiB and a rest.
  const auto source =
      node::makeProcedural("homogeneous", {1024, 1024, 70}, VoxelType::kU8, glm::dvec3{1});
  std::vector<double> parts;
  node::WriteOptions options;
  options.progress = [&](double part) { parts.push_back(part); };
  node::writeVolume(*source, folder.path() / "a.raw", options);
  EXPECT_EQ(parts, (std::vector<double>{32.0 / 70, 64.0 / 70, 1}));
  options.progress = [](double) { throw std::runtime_error{"stop"}; };
  EXPECT_THROW(node::writeVolume(*source, folder.path() / "b.raw", options), std::runtime_error);
  EXPECT_THAT(folder.names(), ElementsAre("a.raw"));
}

}  // namespace
}  // namespace burin::test
