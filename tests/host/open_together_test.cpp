// Volumes that all ranks open together, each one wrong in another way: all ranks throw the same
// error, which is one line and the only one. And the headers of a DICOM folder are read by one
// rank.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <optional>

#include "burin/common/error.hpp"
#include "burin/host/scene_setup.hpp"
#include "burin/host/shared_error.hpp"
#include "burin/node/survey.hpp"
#include "node/dicom_bytes.hpp"
#include "support/mpi_test.hpp"
#include "support/temporary_folder.hpp"

namespace burin::host {
namespace {

namespace fs = std::filesystem;

using test::DicomBytes;
using test::TemporaryFolder;
using test::world;
using ::testing::HasSubstr;

class OpenTogether : public ::testing::Test {
 protected:
  void TearDown() override { barrier(world()); }  // before rank 0's folder goes

  /// Collective. Lets rank 0 write into the folder that all of them read.
  template <typename Work>
  void fill(Work&& work) const {
    if (world().isRoot()) work(folder_);
    barrier(world());
  }
  /// Of a file in it, on any rank.
  std::string path(const std::string& name) const { return rootsFolder_ + "/" + name; }

 private:
  const TemporaryFolder folder_;
  const std::string rootsFolder_ = broadcastText(world(), folder_.path().string(), Rank{0});
};

/// What every rank says of a volume that all of them open and read; expects that nobody, library
/// or burin, wrote anything meanwhile.
Error saidByAll(const VolumeChoice& choice) {
  ::testing::internal::CaptureStderr();
  Error said{ExitCode::kDone, "nothing failed"};
  try {
    const auto source = openTogether(world(), choice);
    node::surveyVolume(world(), *source, {});
  } catch (const Error& error) {  // SharedError or CollectiveError
    said = Error{error.code(), error.what()};
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << choice.file;
  return said;
}

/// A file that ought to be refused, and why.
struct RefusedFile {
  const char* file;
  std::string says;
};

std::string nrrdText(std::string_view fields, std::string_view data) {
  return fmt::format("NRRD0004\n{}\n\n{}", fields, data);
}

std::string eightBytes(std::string_view sizes) {
  return fmt::format("type: uint8\ndimension: 3\nsizes: {}\nencoding: raw", sizes);
}

void writeNrrds(const TemporaryFolder& folder) {
  folder.write("cut.nrrd", nrrdText(eightBytes("4 4 4"), "too few"));
  folder.write("two.nrrd",
               nrrdText("type: uint8\ndimension: 2\nsizes: 4 2\nencoding: raw", "12345678"));
  folder.write("zero.nrrd", nrrdText(eightBytes("0 2 2"), "12345678"));
  folder.write("minus.nrrd", nrrdText(eightBytes("-2 2 2"), "12345678"));
  folder.write("overflow.nrrd",
               nrrdText(eightBytes("2000000000 2000000000 2000000000"), "12345678"));
  folder.write("type.nrrd",
               nrrdText("type: quaternion\ndimension: 3\nsizes: 2 2 2\nencoding: raw", "12345678"));
  folder.write("rgb.nrrd",
               nrrdText("type: uint8\ndimension: 4\nsizes: 3 1 2 1\nkinds: RGB-color domain "
                        "domain domain\nencoding: raw",
                        "abcdef"));
  for (const char* data : {"absent", "folder", "fifo", "loop"})
    folder.write(fmt::format("to-{}.nhdr", data),
                 nrrdText(fmt::format("{}\ndata file: {}", eightBytes("2 2 2"), data), ""));
  folder.write("to-device.nhdr", nrrdText(eightBytes("2 2 2") + "\ndata file: /dev/zero", ""));
}

void writeOddFiles(const TemporaryFolder& folder) {
  fs::create_directory(folder / "folder");
  ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
  ASSERT_EQ(::mkfifo((folder / "fifo.nrrd").c_str(), 0600), 0);
  fs::create_symlink("loop", folder / "loop");
  fs::create_symlink("loop.nrrd", folder / "loop.nrrd");
  fs::create_symlink("/dev/zero", folder / "device.nrrd");
}

/// Nobody writes to the FIFOs: whoever opens one waits for ever.
TEST_F(OpenTogether, BadFilesEndOnAllRanksInOneLine) {
  fill([](const TemporaryFolder& here) {
    writeNrrds(here);
    writeOddFiles(here);
  });
  for (const auto& [file, says] : {RefusedFile{"none.nrrd", "no such file"},
                                   {"folder", "without DICOM images"},
                                   {"fifo.nrrd", "not a regular file"},
                                   {"device.nrrd", "not a regular file"},
                                   {"loop.nrrd", "symbolic links"},
                                   {"cut.nrrd", "truncated"},
                                   {"two.nrrd", "2 dimensions"},
                                   {"zero.nrrd", "bad NRRD header"},
                                   {"minus.nrrd", "bad NRRD header"},
                                   {"overflow.nrrd", "too large"},
                                   {"type.nrrd", "bad NRRD header"},
                                   {"rgb.nrrd", "--component 0 ... 2"},
                                   {"to-absent.nhdr", "absent: no such file"},
                                   {"to-folder.nhdr", "folder: not a regular file"},
                                   {"to-fifo.nhdr", "fifo: not a regular file"},
                                   {"to-device.nhdr", "/dev/zero: not a regular file"},
                                   {"to-loop.nhdr", "symbolic links"}}) {
    VolumeChoice choice;
    choice.file = path(file);
    const Error error = saidByAll(choice);
    EXPECT_EQ(error.code(), ExitCode::kVolume) << file;
    EXPECT_THAT(error.what(), HasSubstr(choice.file));
    EXPECT_THAT(error.what(), HasSubstr(says));
    EXPECT_EQ(std::string{error.what()}.find('\n'), std::string::npos) << error.what();
  }
}

TEST_F(OpenTogether, NoVolumeAtAll) {
  const Error error = saidByAll(VolumeChoice{});
  EXPECT_EQ(error.code(), ExitCode::kUsage);
  EXPECT_THAT(error.what(), HasSubstr("--volume"));
}

/// `count` slices of 4 x 2 pixels, one unit apart but for one in the middle that is `gap` away.
void writeSeries(const TemporaryFolder& folder, const char* name, int count, double gap = 1) {
  fs::create_directory(folder / name);
  for (int i = 0; i < count; ++i) {
    DicomBytes slice;
    slice.number = i;
    slice.z = i < count / 2 ? i : i - 1 + gap;
    folder.write(fmt::format("{}/{}.dcm", name, i), slice.bytes());
  }
}

TEST_F(OpenTogether, BrokenDicomFoldersEndOnAllRanksInOneLine) {
  fill([](const TemporaryFolder& here) {
    writeSeries(here, "gap", 6, 2.5);
    writeSeries(here, "mixed", 3);
    DicomBytes other;
    other.series = "1.2.3.9";
    here.write("mixed/other.dcm", other.bytes());
    writeSeries(here, "cut", 3);
    here.write("cut/1.dcm", DicomBytes{}.bytes().substr(0, DicomBytes{}.bytes().size() - 4));
    writeSeries(here, "damaged", 5);
    here.write("damaged/1.dcm", std::string(128, '\0') + "DICM and no more");
  });
  for (const auto& [name, says] : {RefusedFile{"gap", "slices are missing"},
                                   {"mixed", "2 DICOM series"},
                                   {"cut", "truncated"},
                                   {"damaged", "1.dcm: truncated or damaged"}}) {
    VolumeChoice choice;
    choice.file = path(name);
    const Error error = saidByAll(choice);
    EXPECT_EQ(error.code(), ExitCode::kVolume) << name;
    EXPECT_THAT(error.what(), HasSubstr(says));
    EXPECT_EQ(std::string{error.what()}.find('\n'), std::string::npos) << error.what();
  }
}

/// Calls of read() and its like that this process has made; none where the kernel does not say.
std::optional<std::int64_t> readCalls() {
  std::ifstream in{"/proc/self/io"};
  std::string key;
  for (std::int64_t value = 0; in >> key >> value;)
    if (key == "syscr:") return value;
  return std::nullopt;
}

/// What opening a folder takes on this rank, in calls of read().
std::int64_t callsToOpen(const std::string& folder, int slices) {
  VolumeChoice choice;
  choice.file = folder;
  const std::int64_t before = readCalls().value();
  const auto source = openTogether(world(), choice);
  const std::int64_t calls = readCalls().value() - before;
  EXPECT_EQ(source->info().grid.dims, glm::ivec3(4, 2, slices));
  // The table that rank 0 hands out is all that it takes to read the pixels.
  std::vector<std::byte> voxels(source->info().bytes());
  source->load({glm::ivec3{0}, source->info().grid.dims}, voxels);
  EXPECT_EQ(voxels.back(), std::byte{DicomBytes{}.pixels.back()});
  return calls;
}

// A header takes at least one read() of its file. The first folder has the libraries loaded; on
// ranks other than 0 the larger one then takes no more than the smaller one, but for what MPI may
// read while it waits.
TEST_F(OpenTogether, HeadersOfADicomFolderAreReadByOneRank) {
  if (!readCalls()) GTEST_SKIP() << "no /proc/self/io";
  constexpr int kFew = 4, kMany = 200;
  fill([](const TemporaryFolder& here) {
    writeSeries(here, "few", kFew);
    writeSeries(here, "many", kMany);
  });
  callsToOpen(path("few"), kFew);
  const std::int64_t more = callsToOpen(path("many"), kMany) - callsToOpen(path("few"), kFew);
  if (world().isRoot())
    EXPECT_GE(more, kMany - kFew);
  else
    EXPECT_LT(more, (kMany - kFew) / 4);
}

}  // namespace
}  // namespace burin::host
