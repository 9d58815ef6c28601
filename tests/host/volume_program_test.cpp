#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "host/program.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

using test::onlyLine;
using test::runBurin;
using test::TemporaryFolder;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string infoOf(const std::vector<std::string>& arguments, int ranks = 0) {
  std::vector<std::string> all{"info"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const auto result = runBurin(all, ranks);
  EXPECT_EQ(result.exitCode, 0) << result.err;
  return result.out;
}

TEST(MakeVolume, InfoReadsBackWhatWasMade) {
  const TemporaryFolder folder;
  const auto made = runBurin({"make-volume", "ramp", "--dims", "9,8,7", "--type", "u16",
                              "--spacing", "0.5,1,2", "-o", folder / "ramp.nrrd"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  EXPECT_THAT(folder.names(), ElementsAre("ramp.nrrd"));
  const std::string info = infoOf({folder / "ramp.nrrd"});
  EXPECT_THAT(info, HasSubstr("9 x 8 x 7"));
  EXPECT_THAT(info, HasSubstr("u16"));
  EXPECT_THAT(info, HasSubstr("0.5 1 2"));
  EXPECT_THAT(info, HasSubstr("0 … 4095"));  // u16 volumes use 12 bits, the ramp all of them
  EXPECT_THAT(info, HasSubstr("0 NaN, 0 infinite"));
  EXPECT_EQ(infoOf({folder / "ramp.nrrd", "--histogram2d", folder / "h.png"}, 3), info);
  std::ifstream picture{folder / "h.png", std::ios::binary};
  std::string signature(4, ' ');
  picture.read(signature.data(), 4);
  EXPECT_EQ(signature, "\x89PNG");
}

TEST(MakeVolume, BadKindAndBadFolder) {
  const TemporaryFolder folder;
  const auto kind = runBurin({"make-volume", "rmp", "--dims", "4,4,4", "-o", folder / "a.nrrd"}, 3);
  EXPECT_EQ(kind.exitCode, 2);
  EXPECT_THAT(onlyLine(kind.err), HasSubstr("ramp"));
  const auto place =
      runBurin({"make-volume", "ramp", "--dims", "4,4,4", "-o", folder / "b/a.nrrd"});
  EXPECT_EQ(place.exitCode, 2);
  EXPECT_THAT(onlyLine(place.err), HasSubstr("b/a.nrrd"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Info, BareRawFileWithOptions) {
  const TemporaryFolder folder;
  std::ofstream file{folder / "bytes", std::ios::binary};
  for (int i = 0; i < 24; ++i) file.put('\1').put(static_cast<char>(i));  // 0x0100 + i, big-endian
  file.close();
  const std::string info = infoOf({folder / "bytes", "--dims", "2,3,4", "--type", "u16", "--endian",
                                   "big", "--spacing", "1,1,3"});
  EXPECT_THAT(info, HasSubstr("2 x 3 x 4"));
  EXPECT_THAT(info, HasSubstr("256 … 279"));
  EXPECT_THAT(info, HasSubstr("1 1 3"));
}

TEST(Info, HasNoNegativeZeros) {
  const TemporaryFolder folder;
  folder.write("a.nrrd",
               "NRRD0004\ntype: uint8\ndimension: 3\nspace: RAS\nsizes: 2 2 2\n"
               "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n"
               "encoding: raw\n\n12345678");
  const std::string info = infoOf({folder / "a.nrrd"});
  EXPECT_THAT(info, HasSubstr("x (-1 0 0), y (0 -1 0), z (0 0 1)"));  // RAS in LPS
  EXPECT_THAT(info, ContainsRegex("origin +0 0 0\n"));
}

TEST(Info, CountsWhatIsNotFinite) {
  const TemporaryFolder folder;
  const float values[] = {0, 1, -2.5f, NAN, INFINITY, -INFINITY, NAN, 3};
  std::ofstream{folder / "v_2x2x2_float32.raw", std::ios::binary}.write(
      reinterpret_cast<const char*>(values), sizeof(values));
  const std::string info = infoOf({folder / "v_2x2x2_float32.raw"});
  EXPECT_THAT(info, HasSubstr("2 NaN, 2 infinite"));
  EXPECT_THAT(info, HasSubstr("-2.5 … 3"));
}

TEST(Info, DrawsAHistogram) {
  const TemporaryFolder folder;
  std::ofstream{folder / "v_4x4x4_uint8.raw"} << std::string(32, '\0') << std::string(32, '\77');
  const std::string info = infoOf({folder / "v_4x4x4_uint8.raw"});
  // 64 values in 64 columns, the first and the last of them equally tall.
  EXPECT_THAT(info, HasSubstr("\n  █" + std::string(62, ' ') + "█\n"));
  EXPECT_THAT(info, ContainsRegex("\n  0 +63\n"));
}

TEST(Info, ShowsEncodingAndComponents) {
  const TemporaryFolder folder;
  folder.write("rgb.mha",
               "ObjectType = Image\nNDims = 3\nDimSize = 1 2 2\nElementType = MET_CHAR\n"
               "ElementNumberOfChannels = 3\nElementDataFile = LOCAL\nabcdefghijkl");
  const std::string info = infoOf({folder / "rgb.mha", "--component", "2"}, 3);
  EXPECT_THAT(info, HasSubstr("MetaImage, raw i8, 3 components per voxel"));
  EXPECT_THAT(info, HasSubstr("99 … 108"));  // c … l
}

TEST(Info, BrokenVolumesEndInOneLineWhateverTheRanks) {
  const TemporaryFolder folder;
  const std::string fields =
      "ObjectType = Image\nNDims = 3\nDimSize = 64 64 64\nElementType = MET_UCHAR\n";
  folder.write("absent.mhd", fields + "ElementDataFile = absent.raw\n");
  folder.write("stream.mha", fields + "CompressedData = True\nElementDataFile = LOCAL\n" +
                                 std::string(500, '\x55'));
  folder.write("colours.mha", fields + "ElementNumberOfChannels = 3\nElementDataFile = LOCAL\n");
  std::filesystem::create_directory(folder / "empty");
  for (const auto& [file, part] : {std::pair{"absent.mhd", "absent.raw: no such file"},
                                   {"stream.mha", "zlib stream is damaged"},
                                   {"colours.mha", "--component 0 ... 2"},
                                   {"empty", "without DICOM images"}}) {
    for (const int ranks : {1, 3}) {
      const auto result = runBurin({"info", folder / file}, ranks);
      EXPECT_EQ(result.exitCode, 3) << file;
      EXPECT_THAT(onlyLine(result.err), HasSubstr(part));
      EXPECT_THAT(result.out, IsEmpty());
    }
  }
}

/// A NIfTI-1 file of 4 x 4 x 4 u8 voxels whose values are twice what is stored, plus one.
void writeScaledNifti(const std::string& path) {
  std::string file(352 + 64, '\0');
  const auto put = [&](std::size_t at, auto value) {
    std::memcpy(file.data() + at, &value, sizeof value);
  };
  put(0, std::int32_t{348});
  put(40, std::int16_t{3});
  for (std::size_t axis = 1; axis < 8; ++axis) {
    put(40 + 2 * axis, static_cast<std::int16_t>(axis <= 3 ? 4 : 1));
    put(76 + 4 * axis, 1.0f);
  }
  put(70, std::int16_t{2});  // unsigned char
  put(72, std::int16_t{8});
  put(76, 1.0f);
  put(108, 352.0f);
  put(112, 2.0f);
  put(116, 1.0f);
  std::memcpy(file.data() + 344, "n+1", 4);
  std::ofstream{path, std::ios::binary} << file;
}

TEST(Info, WhatIsDoneToAVolumeIsSaidOnceWhateverTheRanks) {
  const TemporaryFolder folder;
  writeScaledNifti(folder / "scaled.nii");
  const auto result = runBurin({"info", folder / "scaled.nii"}, 3);
  ASSERT_EQ(result.exitCode, 0) << result.err;
  EXPECT_THAT(onlyLine(result.err),
              HasSubstr("u8 voxels delivered as f32 (value = stored * 2 + 1)"));
}

}  // namespace
}  // namespace burin
