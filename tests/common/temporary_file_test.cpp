#include "burin/common/temporary_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "burin/common/error.hpp"
#include "support/temporary_folder.hpp"

namespace burin {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string contents(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream{file}.rdbuf();
  return text.str();
}

ExitCode codeOf(const fs::path& target) {
  try {
    checkWritable(target);
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::kDone;
}

TEST(TemporaryFile, UncommittedLeavesNothing) {
  const TemporaryFolder folder;
  {
    const TemporaryFile file{folder / "a.txt"};
    EXPECT_EQ(file.path().parent_path(), folder.path());
    EXPECT_TRUE(fs::exists(file.path()));
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(TemporaryFile, OldFileStaysUntilCommit) {
  const TemporaryFolder folder;
  std::ofstream{folder / "a.txt"} << "old";
  TemporaryFile file{folder / "a.txt"};
  const std::string text{"new"};
  file.write(std::as_bytes(std::span{text}));
  file.write(std::as_bytes(std::span{text}));
  EXPECT_EQ(contents(folder / "a.txt"), "old");
  file.close();
  EXPECT_EQ(contents(folder / "a.txt"), "old");
  EXPECT_EQ(contents(file.path()), "newnew");
  file.commit();
  EXPECT_EQ(contents(folder / "a.txt"), "newnew");
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

TEST(TemporaryFile, TwoOfOneTargetDoNotMeet) {
  const TemporaryFolder folder;
  const TemporaryFile one{folder / "a.txt"};
  const TemporaryFile two{folder / "a.txt"};
  EXPECT_NE(one.path(), two.path());
}

TEST(TemporaryFile, LinkIsFollowed) {
  const TemporaryFolder folder;
  std::ofstream{folder / "real.txt"} << "old";
  fs::create_symlink("real.txt", folder / "link.txt");
  writeTextFile(folder / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(contents(folder / "real.txt"), "new");
}

TEST(TemporaryFile, RefusesWhatCannotBeWritten) {
  const TemporaryFolder folder;
  std::ofstream{folder / "file"} << "x";
  EXPECT_EQ(codeOf(folder / "fine.txt"), ExitCode::kDone);
  EXPECT_EQ(codeOf(folder / "missing/a.txt"), ExitCode::kUsage);
  EXPECT_EQ(codeOf(folder / "file/a.txt"), ExitCode::kUsage);
  EXPECT_EQ(codeOf(folder.path()), ExitCode::kUsage);
  EXPECT_EQ(codeOf("/dev/null"), ExitCode::kUsage);
  EXPECT_THAT(folder.names(), ElementsAre("file"));
}

TEST(TemporaryFile, WritesTextAsItIs) {
  const TemporaryFolder folder;
  const std::string text{"a\r\n\0b", 5};
  writeTextFile(folder / "a.txt", text);
  EXPECT_EQ(contents(folder / "a.txt"), text);
  EXPECT_THAT(folder.names(), ElementsAre("a.txt"));
}

}  // namespace
}  // namespace burin
