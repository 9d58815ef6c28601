// Everything that can be wrong with a volume: one line that names the file and what was expected.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "burin/common/error.hpp"
#include "dicom_bytes.hpp"
#include "nifti_bytes.hpp"
#include "volume_files.hpp"

namespace burin::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Opens the volume and loads all of it; the error that comes of it.
Error errorOf(const VolumeChoice& choice) {
  try {
    const auto source = node::openVolume(choice);
    std::vector<std::byte> voxels(source->info().bytes());
    source->load({glm::ivec3{0}, source->info().grid.dims}, voxels);
  } catch (const Error& error) {
    return error;
  }
  return Error{ExitCode::kDone, "nothing failed"};
}

/// What libraries have to say, whatever they are told, would be a second line.
class VolumeErrors : public testing::Test {
 protected:
  void SetUp() override { testing::internal::CaptureStderr(); }
  void TearDown() override { EXPECT_EQ(testing::internal::GetCapturedStderr(), ""); }

  void expectError(const VolumeChoice& choice, ExitCode code,
                   const std::vector<std::string>& parts) {
    const Error error = errorOf(choice);
    const std::string message = error.what();
    EXPECT_EQ(error.code(), code) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const auto& part : parts) EXPECT_THAT(message, HasSubstr(part));
  }
  void expectError(std::string_view name, std::string_view bytes,
                   const std::vector<std::string>& parts) {
    std::vector<std::string> all = parts;
    all.emplace_back(name);
    expectError(fileChoice(folder_.write(name, bytes)), ExitCode::kVolume, all);
  }

  static std::string nrrd(std::string_view fields, std::string_view data) {
    return fmt::format("NRRD0004\n{}\n\n{}", fields, data);
  }
  static constexpr const char* kGzipFields =
      "type: uint8\ndimension: 3\nsizes: 10 10 10\nencoding: gzip";

  TemporaryFolder folder_;
};

TEST_F(VolumeErrors, Files) {
  expectError(fileChoice((folder_.path() / "none.nrrd").string()), ExitCode::kVolume,
              {"none.nrrd", "no such file"});
  expectError(fileChoice(folder_.path().string()), ExitCode::kVolume, {"without DICOM images"});
  expectError("a.xyz", "something", {"unknown file format", ".nrrd", ".nii.gz", "--dims"});
  expectError("empty.nrrd", "", {"bad NRRD header"});
}

TEST_F(VolumeErrors, NrrdHeaders) {
  const std::string eight(8, 'v');
  expectError("garbage.nrrd", "NRRD0004\nno field at all\n\n", {"bad NRRD header", "no field"});
  expectError("magic.nrrd", "NRRDnan\ntype: uint8\n\nv", {"bad NRRD header", "NRRD0006"});
  expectError("two.nrrd", nrrd("type: uint8\ndimension: 2\nsizes: 4 2\nencoding: raw", eight),
              {"2 dimensions", "4 x 2", "expected a volume with 3"});
  expectError("four.nrrd", nrrd("type: uint8\ndimension: 4\nsizes: 2 2 2 1\nencoding: raw", eight),
              {"4 dimensions"});
  expectError("rgb.nrrd",
              nrrd("type: uint8\ndimension: 3\nsizes: 3 2 1\nkinds: RGB-color domain domain\n"
                   "encoding: raw",
                   "abcdef"),
              {"3 dimensions", "3 x 2 x 1", "axis 0 holds components"});
  expectError("between.nrrd",
              nrrd("type: uint8\ndimension: 4\nsizes: 1 3 2 1\nkinds: domain vector domain domain\n"
                   "encoding: raw",
                   "abcdef"),
              {"axis 1 holds components", "1 x 3 x 2 x 1", "the first or the last"});
  expectError("colour.nrrd",
              nrrd("type: uint8\ndimension: 4\nsizes: 3 1 2 1\nkinds: RGB-color domain domain "
                   "domain\nencoding: raw",
                   "abcdef"),
              {"3 components per voxel", "--component 0 ... 2"});
  expectError("zero.nrrd", nrrd("type: uint8\ndimension: 3\nsizes: 0 2 2\nencoding: raw", eight),
              {"bad NRRD header"});
  expectError("negative.nrrd",
              nrrd("type: uint8\ndimension: 3\nsizes: -2 2 2\nencoding: raw", eight),
              {"bad NRRD header"});
  expectError("huge.nrrd",
              nrrd("type: uint8\ndimension: 3\nsizes: 3000000000 2 2\nencoding: raw", eight),
              {"3000000000 x 2 x 2"});
  // Longer than the library's messages.
  const std::string sizes = "\ndimension: 3\nsizes: 2 2 2\nencoding: raw";
  expectError("long.nrrd", nrrd("type: " + std::string(1100, 'u') + sizes, eight),
              {"bad NRRD header", "line 2 has 1106 bytes", "at most 512"});
  expectError("almost.nrrd", nrrd("type: " + std::string(506, 'u') + sizes, eight),
              {"bad NRRD header", "couldn't parse type"});
  fs::path folders = folder_.path();
  for (const char letter : {'a', 'b', 'c', 'd'}) folders /= std::string(200, letter);
  fs::create_directories(folders);
  const std::string deep = (folders / "deep.nrrd").string();
  std::ofstream{deep} << nrrd("type: uchar", eight);
  expectError(fileChoice(deep), ExitCode::kVolume, {"deep.nrrd", "at most 768 for NRRD"});
  // Found to be wrong when the data have been opened.
  const std::string pairs =
      "type: uint8\ndimension: 4\nsizes: 2 1 2 2\nkinds: RGB-color domain domain domain\n";
  folder_.write("pairs.raw", eight);
  expectError("pairs.nrrd", nrrd(pairs + "encoding: raw", eight), {"bad NRRD header", "RGB-color"});
  expectError("pairs.nhdr", nrrd(pairs + "encoding: raw\ndata file: pairs.raw", ""),
              {"bad NRRD header", "RGB-color"});
  expectError("flat.nrrd",
              nrrd("type: uint8\ndimension: 3\nspace: RAS\nsizes: 2 2 2\n"
                   "space directions: (1,0,0) (0,1,0) (1,1,0)\nencoding: raw",
                   eight),
              {"lie in one plane"});
}

TEST_F(VolumeErrors, NrrdTypesAndEncodings) {
  expectError(
      "block.nrrd",
      nrrd("type: block\nblock size: 3\nendian: little\ndimension: 3\nsizes: 1 1 1\nencoding: raw",
           "abc"),
      {"voxel type", "block", "not supported", "u8, i8, u16"});
  expectError("ascii.nrrd",
              nrrd("type: uint8\ndimension: 3\nsizes: 2 2 1\nencoding: ascii", "7 8 256 9"),
              {"\"256\"", "u8 number", "number 2"});
  expectError("word.nrrd",
              nrrd("type: float\ndimension: 3\nsizes: 2 1 1\nencoding: ascii", "7 eight"),
              {"\"eight\"", "f32 number"});
  expectError("few.nrrd",
              nrrd("type: uint8\ndimension: 3\nsizes: 2 2 1\nencoding: ascii", "7 8 19     \n"),
              {"ends early, after 3 numbers", "4 expected"});
  expectError("hex.nrrd", nrrd("type: uint8\ndimension: 3\nsizes: 1 1 1\nencoding: hex", "7f"),
              {"encoding", "expected raw, gzip or ascii"});
  expectError("noendian.nrrd",
              nrrd("type: uint16\ndimension: 3\nsizes: 1 1 1\nencoding: raw", "ab"), {"endian"});
}

TEST_F(VolumeErrors, NrrdDataFiles) {
  const std::string fields = "type: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n";
  expectError("lost.nhdr", nrrd(fields + "data file: nowhere.raw", ""), {"nowhere.raw"});
  folder_.write("short.raw", "12345");
  const std::string header = folder_.write("short.nhdr", nrrd(fields + "data file: short.raw", ""));
  expectError(fileChoice(header), ExitCode::kVolume,
              {"short.raw", "truncated", "5 bytes found", "8 expected"});
  folder_.write("1.raw", "1234");
  folder_.write("2.raw", "5678");
  expectError("list.nhdr", "NRRD0004\n" + fields + "data file: LIST\n1.raw\n2.raw\n",
              {"several data files"});
}

// Nobody writes to these FIFOs: whoever opens one waits for ever.
TEST_F(VolumeErrors, NrrdDataFileIsAFifo) {
  const std::string fifo = folder_ / "f.raw";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  std::filesystem::create_directory(folder_ / "folder");
  const std::string fields = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n";
  const std::vector<std::string> parts{"f.raw", "not a regular file"};
  const auto expectRefused = [&](const std::string& field) {
    expectError(fileChoice(folder_.write("a.nhdr", fields + field)), ExitCode::kVolume, parts);
  };
  expectRefused("data file: f.raw\n");
  expectRefused("DataFile:  " + fifo + "\r\n");
  expectRefused("data file: LIST\nf.raw\n");
  expectError("b.nhdr", fields + "data file: folder\n", {"folder", "not a regular file"});
  expectError("c.nhdr", fields + "data file: f%d.raw 1 2 1\n", {"several data files"});
}

TEST_F(VolumeErrors, NiftiPartIsAFifo) {
  NiftiBytes header;
  header.magic = std::string{"ni1\0", 4};
  header.voxOffset = 0;
  ASSERT_EQ(::mkfifo((folder_ / "a.hdr").c_str(), 0600), 0);
  expectError(fileChoice(folder_.write("a.img", "12345678")), ExitCode::kVolume,
              {"a.hdr", "not a regular file"});
  ASSERT_EQ(::mkfifo((folder_ / "b.img").c_str(), 0600), 0);
  expectError(fileChoice(folder_.write("b.hdr", header.bytes(false))), ExitCode::kVolume,
              {"b.img", "not a regular file"});
}

TEST_F(VolumeErrors, LinksThatLeadNowhere) {
  std::filesystem::create_symlink("loop.nrrd", folder_ / "loop.nrrd");
  expectError(fileChoice(folder_ / "loop.nrrd"), ExitCode::kVolume,
              {"loop.nrrd", "levels of symbolic links"});
  std::filesystem::create_symlink("nowhere.nrrd", folder_ / "link.nrrd");
  expectError(fileChoice(folder_ / "link.nrrd"), ExitCode::kVolume, {"link.nrrd", "no such file"});
  NiftiBytes header;
  header.magic = std::string{"ni1\0", 4};
  header.voxOffset = 0;
  std::filesystem::create_symlink("a.img", folder_ / "a.img");
  expectError(fileChoice(folder_.write("a.hdr", header.bytes(false))), ExitCode::kVolume,
              {"a.img", "levels of symbolic links"});
  std::filesystem::create_symlink("s%d.png", folder_ / "s%d.png");
  expectError(fileChoice(folder_ / "s%d.png"), ExitCode::kVolume, {"s%d.png"});
}

TEST_F(VolumeErrors, TruncatedRawFiles) {
  const std::string header =
      "NRRD0004\ntype: uint16\ndimension: 3\nsizes: 4 4 4\n"
      "endian: little\nencoding: raw\n\n";
  expectError("cut.nrrd", header + std::string(100, 'v'),
              {"truncated", fmt::format("{} bytes found, {} expected", header.size() + 100,
                                        header.size() + 128)});
  NiftiBytes nifti;
  nifti.dim = {3, 4, 4, 4, 1, 1, 1, 1};
  expectError("cut.nii", nifti.bytes(false) + std::string(63, 'v'),
              {"truncated", "415 bytes found, 416 expected"});
}

TEST_F(VolumeErrors, NiftiHeadersThatTheLibraryWritesAbout) {
  NiftiBytes unknownType;
  unknownType.datatype = 3;
  NiftiBytes tooMany;
  tooMany.dim[0] = 9;
  NiftiBytes empty;
  empty.dim[1] = 0;
  expectError("type.nii", unknownType.bytes(false) + "v", {"voxel type 3", "expected u8"});
  expectError("many.nii", tooMany.bytes(false) + "v", {"dim is 9", "expected 1 to 7"});
  expectError("none.nii", empty.bytes(false) + "v", {"dim is 3 0"});
  for (const std::int16_t dim : std::initializer_list<std::int16_t>{0, -4}) {
    NiftiBytes flat;
    flat.dim[2] = dim;
    expectError("flat.nii", flat.bytes(false) + "v", {"at least 1 each"});
  }
  for (NiftiBytes* header : {&unknownType, &tooMany, &empty}) header->magic = std::string(4, '\0');
  expectError("old-type.nii", unknownType.bytes(false) + "v", {"voxel type 3", "expected u8"});
  expectError("old-many.nii", tooMany.bytes(true) + "v", {"dim is", "expected 1 to 7"});
  expectError("old-none.nii", empty.bytes(true) + "v", {"dim is 3 0"});
  std::string second = NiftiBytes{}.bytes(false) + "v";
  second.replace(0, 12, encoded(std::int32_t{540}, false) + std::string{"n+2\0\r\n\032\n", 8});
  expectError("second.nii", second, {"not a valid NIfTI header"});
}

TEST_F(VolumeErrors, Gzip) {
  const std::string voxels = encoded(sampleVoxels<std::uint8_t>(1000), false);
  const std::string stream = gzipped(voxels);
  expectError("early.nrrd", nrrd(kGzipFields, stream.substr(0, stream.size() / 2)), {"ends early"});
  expectError("nothing.nrrd", nrrd(kGzipFields, ""), {"ends early, after 0"});
  std::string damaged = stream;
  damaged[stream.size() - 6] = static_cast<char>(damaged[stream.size() - 6] ^ 1);  // its check sum
  expectError("crc.nrrd", nrrd(kGzipFields, damaged), {"damaged", "incorrect data check"});
  expectError("text.nrrd", nrrd(kGzipFields, "this is not gzip"),
              {"damaged", "incorrect header check"});
  expectError("trail.nrrd", nrrd(kGzipFields, stream + "more"), {"not gzip follow"});
  expectError("long.nrrd", nrrd(kGzipFields, gzipped(voxels + "x")),
              {"inflates to more than the 1000 bytes"});
  expectError("short.nrrd", nrrd(kGzipFields, gzipped(voxels.substr(1))),
              {"inflates to 999 bytes, 1000 expected"});
}

// Found when the volume is opened: nobody is to make room for what the header says.
TEST_F(VolumeErrors, GzipHeaderThatLies) {
  for (const char* sizes : {"2000000000 1 1", "60000 60000 1000"}) {
    const std::string file = folder_.write(
        "lie.nrrd", nrrd(fmt::format("type: uint8\ndimension: 3\nsizes: {}\nencoding: gzip", sizes),
                         gzipped("few voxels")));
    try {
      node::openVolume(fileChoice(file));
      ADD_FAILURE() << "opened";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kVolume);
      const std::string most = std::to_string(1032 * gzipped("few voxels").size() + 65536);
      EXPECT_THAT(error.what(), HasSubstr("lie.nrrd"));
      EXPECT_THAT(error.what(), HasSubstr("000000000 bytes expected"));
      EXPECT_THAT(error.what(), HasSubstr(most + " at most"));
    }
  }
}

/// Nothing compresses better than zeros; what zlib makes of them must still be opened.
TEST_F(VolumeErrors, GzipOfZerosIsNoLie) {
  const auto source = node::openVolume(fileChoice(folder_.write(
      "zeros.nrrd", nrrd("type: uint8\ndimension: 3\nsizes: 256 256 64\nencoding: gzip",
                         gzipped(std::string(std::size_t{1} << 22, '\0'))))));
  EXPECT_EQ(source->info().grid.dims, glm::ivec3(256, 256, 64));
}

TEST_F(VolumeErrors, Nifti) {
  NiftiBytes header;
  expectError("garbage.nii", std::string(400, 'x'), {"not a valid NIfTI header"});
  header.datatype = 1536;
  header.bitsPerVoxel = 128;
  expectError("quad.nii", header.bytes(false) + std::string(16, 'v'),
              {"FLOAT128", "not supported", "u8, i8, u16"});
  header = {};
  header.dim = {4, 2, 2, 2, 3, 1, 1, 1};
  expectError("time.nii", header.bytes(false) + std::string(24, 'v'), {"2 x 2 x 2 x 3"});
  header = {};
  header.magic = std::string{"ni1\0", 4};
  header.voxOffset = 0;
  expectError("lonely.hdr", header.bytes(false), {".img"});
}

/// The most memory that this process has had addresses for.
std::uint64_t mostAddresses() {
  std::ifstream in{"/proc/self/status"};
  std::string word;
  std::uint64_t kibibytes = 0;
  while (in >> word && word != "VmPeak:") continue;
  in >> kibibytes;
  return kibibytes << 10;
}

// Where a number of 16 bits stands elsewhere, a text of 4 GB is announced.
TEST_F(VolumeErrors, DicomTextThatLies) {
  std::string bytes = DicomBytes{}.bytes();
  const std::string bitsAllocated =
      encoded(std::uint16_t{0x0028}, false) + encoded(std::uint16_t{0x0100}, false);
  const std::size_t at = bytes.find(bitsAllocated + "US") + bitsAllocated.size();
  bytes.replace(at, 6, "UT" + std::string(2, '\0') + encoded(std::uint32_t{0xfb000004}, false));
  const std::uint64_t before = mostAddresses();
  expectError("lie.dcm", bytes, {"pixels of 0 bits"});
  EXPECT_LT(mostAddresses() - before, std::uint64_t{1} << 30);
}

TEST_F(VolumeErrors, DicomPixelsOfManySamples) {
  for (const std::uint16_t components : std::initializer_list<std::uint16_t>{0, 2, 16385}) {
    DicomBytes slice;
    slice.components = components;
    expectError("many.dcm", slice.bytes(),
                {fmt::format("{} samples per pixel (expected 1, 3 or 4)", components)});
  }
}

// Of some of these DCMTK never comes back.
TEST_F(VolumeErrors, DicomFramesThatAreNoJpeg) {
  for (const std::string begin :
       {"", "\xff\xd0", "\xff\x42", "\xff\xd8\xff\xd0", "\xff\xd8\xff\x42", "\xff\xd8\xff\xd9"}) {
    DicomBytes slice;
    slice.jpeg = begin + std::string("\xff\xe0\x00\x10JFIF", 8) + std::string(40, '\0');
    expectError("no.dcm", slice.bytes(), {"JPEG", "a frame does not begin as JPEG does"});
  }
}

TEST_F(VolumeErrors, RawChoices) {
  VolumeChoice choice = fileChoice(folder_.write("a.raw", "12345678"));
  expectError(choice, ExitCode::kUsage, {"--dims", "--type"});
  choice.dims = glm::ivec3{2};
  expectError(choice, ExitCode::kUsage, {"--type", "u8, i8, u16"});
  choice.type = "u12";
  expectError(choice, ExitCode::kUsage, {"u12", "u8, i8, u16"});
  choice.type = "u8";
  choice.endian = "middle";
  expectError(choice, ExitCode::kUsage, {"middle", "little or big"});
  choice.endian.reset();
  EXPECT_EQ(errorOf(choice).code(), ExitCode::kDone);
  choice.dims = glm::ivec3{0, 2, 2};
  expectError(choice, ExitCode::kUsage, {"0 x 2 x 2"});
  choice.dims = glm::ivec3{2000000000};
  expectError(choice, ExitCode::kUsage, {"more voxels than can be addressed"});
  choice.dims = glm::ivec3{1, 2, 2};
  expectError(choice, ExitCode::kVolume, {"8 bytes found, 4 expected"});
  choice.dims = glm::ivec3{2};
  choice.component = 1;
  expectError(choice, ExitCode::kUsage, {"--component 1", "0 ... 0"});
  choice.component.reset();
  choice.spacing = glm::dvec3{1, 0, 1};
  expectError(choice, ExitCode::kUsage, {"spacing 0"});
  expectError("n_2x2x2_float16.raw", std::string(16, 'v'), {"float16", "u8, i8, u16"});
  expectError("n_2x2x3_uint8.raw", std::string(11, 'v'), {"11 bytes found, 12 expected"});
}

TEST_F(VolumeErrors, RawKeysForASelfDescribingFile) {
  VolumeChoice choice = fileChoice(
      folder_.write("a.nrrd", nrrd("type: uint8\ndimension: 3\nsizes: 1 1 1\nencoding: raw", "v")));
  choice.endian = "big";
  expectError(choice, ExitCode::kUsage, {"bare raw files", "NRRD"});
}

TEST_F(VolumeErrors, Procedural) {
  VolumeChoice choice;
  choice.procedural = "vesels";
  expectError(choice, ExitCode::kUsage, {"vesels", "dims"});
  choice.dims = glm::ivec3{4};
  expectError(choice, ExitCode::kUsage, {"vesels", "did you mean 'vessels'?"});
  choice.procedural = "vessels";
  choice.type = "u9";
  expectError(choice, ExitCode::kUsage, {"u9", "u8, i16, u16, f32"});
  choice.type = "u8";
  choice.dims = glm::ivec3{4, -4, 4};
  expectError(choice, ExitCode::kUsage, {"4 x -4 x 4"});
}

}  // namespace
}  // namespace burin::test
