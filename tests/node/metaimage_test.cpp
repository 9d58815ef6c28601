// MetaImage, where no packaged writer goes: byte orders, lists of files, headers of other programs,
// and everything that can be wrong with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "burin/common/error.hpp"
#include "volume_files.hpp"

namespace burin::test {
namespace {

using testing::HasSubstr;

class MetaImage : public testing::Test {
 protected:
  std::unique_ptr<node::BrickSource> open(std::string_view fields, std::string_view data = "") {
    const std::string file =
        folder_.write("a.mha", fmt::format("ObjectType = Image\n{}{}", fields, data));
    return node::openVolume(fileChoice(file));
  }

  void expectRefused(std::string_view fields, std::string_view data,
                     const std::vector<std::string>& parts) {
    SCOPED_TRACE(fields);
    try {
      const auto source = open(fields, data);
      loadedWhole<std::uint8_t>(*source);
      ADD_FAILURE() << "was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kVolume);
      for (const auto& part : parts) EXPECT_THAT(error.what(), HasSubstr(part));
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
    }
  }

  TemporaryFolder folder_;
};

constexpr const char* kEight = "NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\n";
const std::vector<std::uint8_t> kDigits{'1', '2', '3', '4', '5', '6', '7', '8'};

TEST_F(MetaImage, BothByteOrders) {
  const auto voxels = sampleVoxels<std::uint16_t>(8);
  for (const bool big : {false, true}) {
    const auto source = open(fmt::format("NDims = 3\nDimSize = 2 2 2\nBinaryDataByteOrderMSB = {}\n"
                                         "ElementType = MET_USHORT\nElementDataFile = LOCAL\n",
                                         big ? "True" : "False"),
                             encoded(voxels, big));
    EXPECT_TRUE(source->randomAccess());
    EXPECT_EQ(loadedWhole<std::uint16_t>(*source), voxels);
  }
}

TEST_F(MetaImage, DataInSeveralFiles) {
  folder_.write("s08.raw", "xx1234");
  folder_.write("s10.raw", "xx5678");
  for (const char* files :
       {"LIST\ns08.raw\ns10.raw\n", "LIST 2\ns08.raw\ns10.raw\n", "s%02d.raw 8 10 2\n"}) {
    SCOPED_TRACE(files);
    for (const char* header : {"HeaderSize = 2\n", "HeaderSize = -1\n"}) {
      const auto source = open(fmt::format("{}{}ElementDataFile = {}", kEight, header, files));
      EXPECT_TRUE(source->randomAccess());
      EXPECT_EQ(loadedWhole<std::uint8_t>(*source), kDigits);
      EXPECT_EQ(loaded<std::uint8_t>(*source, {{1, 0, 0}, {2, 1, 2}}),
                (std::vector<std::uint8_t>{'2', '6'}));
    }
  }
}

TEST_F(MetaImage, OrientationAndScale) {
  const auto source =
      open(fmt::format("{}TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 1 2 3\n"
                       "ElementSpacing = 2 3 4\nAnatomicalOrientation = RAI\n"
                       "ElementToIntensityFunctionSlope = 0.5\n"
                       "ElementToIntensityFunctionOffset = -3\nElementDataFile = LOCAL\n",
                       kEight),
           "\1\2\3\4\5\6\7\10");
  EXPECT_TRUE(source->info().anatomical);
  EXPECT_EQ(source->info().grid.worldFromIndex({1, 0, 0}), glm::dvec3(1, 4, 3));
  EXPECT_EQ(source->info().grid.worldFromIndex({0, 1, 0}), glm::dvec3(-2, 2, 3));
  EXPECT_EQ(source->info().grid.worldFromIndex({0, 0, 1}), glm::dvec3(1, 2, 7));
  EXPECT_EQ(loadedWhole<float>(*source),
            (std::vector<float>{-2.5f, -2, -1.5f, -1, -0.5f, 0, 0.5f, 1}));
}

TEST_F(MetaImage, NothingIsAnatomicalWithoutAWord) {
  for (const char* words : {"", "AnatomicalOrientation = ???\n"}) {
    const auto source =
        open(fmt::format("{}{}ElementDataFile = LOCAL\n", kEight, words), "12345678");
    EXPECT_FALSE(source->info().anatomical);
  }
}

TEST_F(MetaImage, Text) {
  const auto source = open(fmt::format("{}BinaryData = False\nElementDataFile = LOCAL\n", kEight),
                           "49 50 51\n52 53 54 55 56\n");
  EXPECT_FALSE(source->randomAccess());
  EXPECT_EQ(loadedWhole<std::uint8_t>(*source), kDigits);
}

TEST_F(MetaImage, BadHeaders) {
  const auto local = [](std::string_view fields) {
    return fmt::format("{}\nElementDataFile = LOCAL\n", fields);
  };
  expectRefused("NDims = 3\n", "", {"ElementDataFile is missing"});
  expectRefused("no field\n", "", {"\"no field\"", "KEY = VALUE"});
  expectRefused(local("NDims = 3\nElementType = MET_UCHAR"), "", {"DimSize is missing"});
  expectRefused(local("NDims = 2\nDimSize = 2 2\nElementType = MET_UCHAR"), "1234",
                {"NDims = 2", "volume with 3"});
  expectRefused(local("NDims = 3\nDimSize = 2 2\nElementType = MET_UCHAR"), "1234",
                {"DimSize \"2 2\"", "3 numbers"});
  expectRefused(local("NDims = 3\nDimSize = 2 0 2\nElementType = MET_UCHAR"), "", {"2 x 0 x 2"});
  expectRefused(local("NDims = 3\nDimSize = 2 -2 2\nElementType = MET_UCHAR"), "", {"2 x -2 x 2"});
  expectRefused(local("NDims = 3\nDimSize = 2000000000 2000000000 2000000000\n"
                      "ElementType = MET_UCHAR"),
                "", {"more voxels than can be addressed"});
  expectRefused(local("NDims = 3\nDimSize = 2 2 99999999999999999999\nElementType = MET_UCHAR"), "",
                {"DimSize", "3 numbers"});
  expectRefused(local("NDims = 3\nDimSize = 2 2 2\nElementType = MET_STRING"), "12345678",
                {"MET_STRING", "UCHAR"});
  expectRefused(local(fmt::format("{}ElementNumberOfChannels = 0", kEight)), "", {"0 components"});
  expectRefused(local(fmt::format("{}ElementNumberOfChannels = 2", kEight)), "1234567812345678",
                {"2 components per voxel", "--component 0 ... 1"});
  expectRefused(local(fmt::format("{}ElementSpacing = 1 1 0", kEight)), "12345678", {"spacing 0"});
  expectRefused(local(fmt::format("{}CompressedData = Perhaps", kEight)), "",
                {"CompressedData", "True"});
}

TEST_F(MetaImage, BadData) {
  const std::string local = fmt::format("{}ElementDataFile = LOCAL\n", kEight);
  expectRefused(local, "1234567", {"a.mha", "truncated", "2 x 2 x 2 voxels of u8"});
  const auto elsewhere = [](std::string_view file) {
    return fmt::format("{}ElementDataFile = {}\n", kEight, file);
  };
  expectRefused(elsewhere("none.raw"), "", {"a.mha", "none.raw", "no such file"});
  expectRefused(elsewhere("."), "", {"a.mha", "not a regular file"});
  expectRefused(elsewhere("/dev/zero"), "", {"/dev/zero", "not a regular file"});
  ASSERT_EQ(::mkfifo((folder_ / "fifo").c_str(), 0600), 0);
  expectRefused(elsewhere("fifo"), "", {"fifo", "not a regular file"});
  std::filesystem::create_symlink("loop", folder_.path() / "loop");
  expectRefused(elsewhere("loop"), "", {"loop"});
  expectRefused(elsewhere("LIST"), "", {"no file is listed"});
  expectRefused(elsewhere("LIST\nnone.raw\n"), "", {"none.raw", "no such file"});
  expectRefused(elsewhere("s%s.raw 1 2 1"), "", {"s%s.raw", "%d"});
  expectRefused(elsewhere("s%d.raw 1 9000000000 1"), "", {"%d"});
  folder_.write("1.raw", "123");
  expectRefused(elsewhere("LIST\n1.raw\n1.raw\n1.raw\n"), "", {"3 data files for 2 slices"});
  expectRefused(elsewhere("LIST\n1.raw\n1.raw\n"), "", {"1.raw", "truncated"});
}

TEST_F(MetaImage, BadStreams) {
  const auto packed = [](std::string_view sizes) {
    return fmt::format(
        "NDims = 3\nDimSize = {}\nElementType = MET_UCHAR\nCompressedData = True\n"
        "ElementDataFile = LOCAL\n",
        sizes);
  };
  const std::string stream = gzipped(encoded(sampleVoxels<std::uint8_t>(1000), false));
  expectRefused(packed("10 10 10"), stream.substr(0, stream.size() / 2), {"ends early"});
  expectRefused(packed("10 10 10"), "this is no stream", {"damaged"});
  expectRefused(packed("10 10 9"), stream, {"inflates to more than the 900 bytes"});
  expectRefused(packed("10 10 11"), stream, {"inflates to 1000 bytes", "1100 expected"});
  expectRefused(packed("60000 60000 1000"), stream, {"bytes expected", "at most"});
}

}  // namespace
}  // namespace burin::test
