// Every format × type × byte order × compression, from files written byte by byte.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "nifti_bytes.hpp"
#include "volume_files.hpp"

namespace burin::test {
namespace {

constexpr glm::ivec3 kDims{7, 5, 6};
constexpr std::size_t kVoxels = 7 * 5 * 6;

template <typename T>
struct TypeNames;
template <>
struct TypeNames<std::uint8_t> {
  static constexpr const char *nrrd = "unsigned char", *openSciVis = "uint8", *ours = "u8";
  static constexpr std::int16_t nifti = 2;
};
template <>
struct TypeNames<std::int16_t> {
  static constexpr const char *nrrd = "short", *openSciVis = "int16", *ours = "i16";
  static constexpr std::int16_t nifti = 4;
};
template <>
struct TypeNames<std::uint16_t> {
  static constexpr const char *nrrd = "ushort", *openSciVis = "uint16", *ours = "u16";
  static constexpr std::int16_t nifti = 512;
};
template <>
struct TypeNames<float> {
  static constexpr const char *nrrd = "float", *openSciVis = "float32", *ours = "f32";
  static constexpr std::int16_t nifti = 16;
};

template <typename T>
class VolumeFormats : public testing::Test {
 protected:
  using Names = TypeNames<T>;

  std::string voxelBytes(bool big) const { return encoded(voxels_, big); }

  std::string nrrdHeader(bool big, std::string_view encoding, std::string_view more = "") const {
    return fmt::format(
        "NRRD0004\n# a comment\ntype: {}\ndimension: 3\nsizes: 7 5 6\nspacings: 0.5 2 1.25\n"
        "endian: {}\nencoding: {}\n{}",
        Names::nrrd, big ? "big" : "little", encoding, more);
  }

  std::string niftiHeader(bool big, std::string_view magic, float voxOffset) const {
    NiftiBytes header;
    header.dim = {3, 7, 5, 6, 1, 1, 1, 1};
    header.datatype = Names::nifti;
    header.bitsPerVoxel = sizeof(T) * 8;
    header.pixdim = {1, 0.5f, 2, 1.25f, 0, 0, 0, 0};
    header.voxOffset = voxOffset;
    header.magic = magic;
    return header.bytes(big);
  }

  /// The whole volume, every slab in ascending and descending order, and random regions.
  void expectVolume(const VolumeChoice& choice, bool randomAccess, bool withSpacing = true) {
    SCOPED_TRACE(choice.file);
    const auto source = node::openVolume(choice);
    EXPECT_EQ(source->info().grid.dims, kDims);
    EXPECT_EQ(source->info().type, kVoxelTypeOf<T>);
    EXPECT_EQ(source->info().name, choice.file);
    EXPECT_EQ(source->randomAccess(), randomAccess);
    EXPECT_FALSE(source->info().anatomical);
    if (withSpacing) {
      EXPECT_EQ(source->info().grid.spacing, glm::dvec3(0.5, 2, 1.25));
    }
    EXPECT_EQ(loadedWhole<T>(*source), voxels_);
    for (int z = 0; z < kDims.z; ++z) expectRegion(*source, {{0, 0, z}, {7, 5, z + 1}});
    for (int z = kDims.z; z-- > 0;) expectRegion(*source, {{0, 0, z}, {7, 5, z + 1}});
    std::mt19937 random{11};
    for (int n = 0; n < 60; ++n) {
      IndexBox box;
      for (int axis = 0; axis < 3; ++axis) {
        const int a = static_cast<int>(random() % static_cast<unsigned>(kDims[axis] + 1));
        const int b = static_cast<int>(random() % static_cast<unsigned>(kDims[axis] + 1));
        box.lo[axis] = std::min(a, b);
        box.hi[axis] = std::max(a, b);
      }
      expectRegion(*source, box);
    }
  }

  void expectRegion(node::BrickSource& source, const IndexBox& box) {
    ASSERT_EQ(loaded<T>(source, box), picked(voxels_, kDims, box));
  }

  TemporaryFolder folder_;
  std::vector<T> voxels_ = sampleVoxels<T>(kVoxels);
};

using VoxelTypes = testing::Types<std::uint8_t, std::int16_t, std::uint16_t, float>;
TYPED_TEST_SUITE(VolumeFormats, VoxelTypes);

TYPED_TEST(VolumeFormats, NrrdAttached) {
  for (const bool big : {false, true}) {
    const std::string voxels = this->voxelBytes(big);
    this->expectVolume(
        fileChoice(this->folder_.write("a.nrrd", this->nrrdHeader(big, "raw") + "\n" + voxels)),
        true);
    this->expectVolume(fileChoice(this->folder_.write(
                           "b.nrrd", this->nrrdHeader(big, "gzip") + "\n" + gzipped(voxels))),
                       false);
    // Skipped bytes lie inside the inflated stream.
    this->expectVolume(
        fileChoice(this->folder_.write("c.nrrd", this->nrrdHeader(big, "gz", "byte skip: 9\n") +
                                                     "\n" + gzipped("123456789" + voxels))),
        false);
  }
}

TYPED_TEST(VolumeFormats, NrrdDetached) {
  for (const bool big : {false, true}) {
    const std::string voxels = this->voxelBytes(big);
    this->folder_.write("plain.bin", "header line\nsecond\nxyz" + voxels);
    this->folder_.write("end.bin", "any number of bytes" + voxels);
    this->folder_.write("packed.bin", gzipped(voxels));
    const auto open = [&](std::string_view encoding, std::string_view more, bool randomAccess) {
      this->expectVolume(
          fileChoice(this->folder_.write("a.nhdr", this->nrrdHeader(big, encoding, more))),
          randomAccess);
    };
    open("raw", "line skip: 2\nbyte skip: 3\ndata file: plain.bin\n", true);
    open("raw", "byte skip: -1\ndata file: end.bin\n", true);  // -1: the voxels end the file
    open("gzip", "data file: packed.bin\n", false);
  }
}

TYPED_TEST(VolumeFormats, Nifti) {
  const std::string single{"n+1\0", 4};
  const std::string pair{"ni1\0", 4};
  for (const bool big : {false, true}) {
    const std::string voxels = this->voxelBytes(big);
    const std::string whole = this->niftiHeader(big, single, 352) + voxels;
    this->expectVolume(fileChoice(this->folder_.write("a.nii", whole)), true);
    this->expectVolume(fileChoice(this->folder_.write("a.nii.gz", gzipped(whole))), false);
    // A gap between header and voxels.
    this->expectVolume(
        fileChoice(this->folder_.write(
            "gap.nii", this->niftiHeader(big, single, 368) + std::string(16, 'x') + voxels)),
        true);
    this->folder_.write("two.img", voxels);
    const std::string header = this->folder_.write("two.hdr", this->niftiHeader(big, pair, 0));
    this->expectVolume(fileChoice(header), true);
    this->expectVolume(fileChoice((this->folder_.path() / "two.img").string()), true);
  }
}

TYPED_TEST(VolumeFormats, Raw) {
  const std::string little = this->voxelBytes(false);
  const auto named = fmt::format("my_volume_7x5x6_{}.raw", TestFixture::Names::openSciVis);
  this->expectVolume(fileChoice(this->folder_.write(named, little)), true, false);
  this->expectVolume(fileChoice(this->folder_.write(named + ".gz", gzipped(little))), false, false);
  VolumeChoice choice = fileChoice(this->folder_.write("voxels.dat", this->voxelBytes(true)));
  choice.dims = kDims;
  choice.type = TestFixture::Names::ours;
  choice.endian = "big";
  choice.spacing = glm::dvec3{0.5, 2, 1.25};
  this->expectVolume(choice, true);
}

TEST(VolumeFormats, GzipMembersInARowAreOneStream) {
  const TemporaryFolder folder;
  const auto voxels = sampleVoxels<std::uint8_t>(kVoxels);
  const std::string bytes = encoded(voxels, false);
  const std::string file = folder.write("v_7x5x6_uint8.raw.gz",
                                        gzipped(bytes.substr(0, 100)) + gzipped(bytes.substr(100)));
  const auto source = node::openVolume(fileChoice(file));
  EXPECT_EQ(loadedWhole<std::uint8_t>(*source), voxels);
}

TEST(VolumeFormats, AStreamLargerThanItsBuffersIsReadInPieces) {
  // 3 MiB that do not compress, so that input buffers are refilled in the middle of things.
  const TemporaryFolder folder;
  const glm::ivec3 dims{128, 96, 256};
  const auto voxels = sampleVoxels<std::uint8_t>(128 * 96 * 256);
  const std::string file =
      folder.write("v_128x96x256_uint8.raw.gz", gzipped(encoded(voxels, false)));
  const auto source = node::openVolume(fileChoice(file));
  for (const IndexBox& box : {IndexBox{{0, 0, 200}, {128, 96, 256}},
                              {{5, 6, 90}, {100, 90, 130}},
                              {{0, 0, 0}, {128, 96, 256}},
                              {{127, 95, 255}, {128, 96, 256}}}) {
    EXPECT_EQ(loaded<std::uint8_t>(*source, box), picked(voxels, dims, box));
  }
}

TEST(VolumeFormats, RawVoxelsMayBeginLikeAGzipStream) {
  const TemporaryFolder folder;
  const std::string bytes = "\x1f\x8b\x08 and more";
  const auto source = node::openVolume(
      fileChoice(folder.write("v_3x2x2_uint8.raw", std::string_view{bytes}.substr(0, 12))));
  EXPECT_EQ(loaded<std::uint8_t>(*source, {{0, 0, 0}, {2, 1, 1}}),
            (std::vector<std::uint8_t>{0x1f, 0x8b}));
}

TEST(VolumeFormats, WideTypesOfBareFiles) {
  const TemporaryFolder folder;
  const auto open = [&](const char* type, const std::string& bytes) {
    VolumeChoice choice = fileChoice(folder.write("v", bytes));
    choice.dims = glm::ivec3{3, 1, 1};
    choice.type = type;
    choice.endian = "big";
    return node::openVolume(choice);
  };
  const auto i8 = open("i8", encoded(std::vector<std::int8_t>{-128, 127, -1}, true));
  EXPECT_EQ(i8->info().type, node::VoxelType::kI16);
  EXPECT_EQ(i8->info().notice, "");  // nothing is lost
  EXPECT_EQ(loadedWhole<std::int16_t>(*i8), (std::vector<std::int16_t>{-128, 127, -1}));
  // 2^24 + 1 and the largest number lie between two floats; ties go to the even one.
  const auto u32 = open("u32", encoded(std::vector<std::uint32_t>{16777217, 4294967295, 7}, true));
  EXPECT_EQ(loadedWhole<float>(*u32), (std::vector<float>{0x1p24f, 0x1p32f, 7}));
  EXPECT_NE(u32->info().notice.find("u32 voxels delivered as f32"), std::string::npos);
  const auto i64 = open("i64", encoded(std::vector<std::int64_t>{-1, 1LL << 62, 3}, true));
  EXPECT_EQ(loadedWhole<float>(*i64), (std::vector<float>{-1, 0x1p62f, 3}));
  const auto f64 = open("f64", encoded(std::vector<double>{0.1, -1e300, 1e-20}, true));
  EXPECT_EQ(loadedWhole<float>(*f64),
            (std::vector<float>{0.1f, -std::numeric_limits<float>::infinity(), 1e-20f}));
}

TEST(VolumeFormats, OneComponentOfNiftiColoursAndVectors) {
  const TemporaryFolder folder;
  NiftiBytes header;
  header.dim = {3, 2, 1, 2, 1, 1, 1, 1};
  header.datatype = 128;  // RGB24: the colours of a voxel lie together
  header.bitsPerVoxel = 24;
  VolumeChoice choice = fileChoice(folder.write("rgb.nii", header.bytes(false) + "rgbRGBxyzXYZ"));
  choice.component = 1;
  EXPECT_EQ(loadedWhole<std::uint8_t>(*node::openVolume(choice)),
            (std::vector<std::uint8_t>{'g', 'G', 'y', 'Y'}));
  header.dim = {5, 2, 1, 2, 1, 3, 1, 1};  // vectors: one volume after another
  header.datatype = 2;
  header.bitsPerVoxel = 8;
  for (const bool isPacked : {false, true}) {
    const std::string bytes = header.bytes(false) + "1234abcdABCD";
    choice = fileChoice(isPacked ? folder.write("v.nii.gz", gzipped(bytes))
                                 : folder.write("v.nii", bytes));
    for (int component = 0; component < 3; ++component) {
      choice.component = component;
      const auto source = node::openVolume(choice);
      EXPECT_EQ(source->info().components, 3);
      const std::string_view expected =
          std::array{"1234", "abcd", "ABCD"}[static_cast<std::size_t>(component)];
      EXPECT_EQ(loadedWhole<std::uint8_t>(*source),
                (std::vector<std::uint8_t>{expected.begin(), expected.end()}));
    }
  }
}

TEST(VolumeFormats, TheUsersSpacingReplacesTheHeaders) {
  const TemporaryFolder folder;
  VolumeChoice choice = fileChoice(folder.write(
      "a.nrrd", "NRRD0001\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n01234567"));
  EXPECT_EQ(node::openVolume(choice)->info().grid.spacing, glm::dvec3{1});
  choice.spacing = glm::dvec3{1, 2, 3};
  EXPECT_EQ(node::openVolume(choice)->info().grid.spacing, glm::dvec3(1, 2, 3));
}

}  // namespace
}  // namespace burin::test
