#include "burin/common/memory_room.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <limits>

#include "support/temporary_folder.hpp"

namespace burin {
namespace {

using test::TemporaryFolder;

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kMebi = 1024 * 1024;

/// A system's folders proc and sys, as far as they are looked at.
class System : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder_.path() / name).parent_path());
    folder_.write(name, text);
  }
  std::int64_t hostRoom() const { return memoryRoom(folder_.path()).host; }

  const TemporaryFolder folder_;
};

TEST_F(System, WithoutNumbersHasNoLimit) {
  EXPECT_EQ(hostRoom(), kNoLimit);
}

TEST_F(System, FreeMemoryAndSwapCount) {
  write("proc/meminfo", "MemTotal: 9000 kB\nMemAvailable:    2048 kB\nSwapFree:  1024 kB\n");
  EXPECT_EQ(hostRoom(), 3 * kMebi);
}

TEST_F(System, TheSmallestLimitOfAGroupAndThoseAroundItHolds) {
  write("proc/meminfo", "MemAvailable: 1048576 kB\n");
  write("proc/self/cgroup", "0::/job/step\n");
  write("sys/fs/cgroup/job/memory.max", "104857600\n");
  write("sys/fs/cgroup/job/memory.current", "52428800\n");
  write("sys/fs/cgroup/job/memory.stat", "anon 41943040\ninactive_file 10485760\n");
  write("sys/fs/cgroup/job/step/memory.max", "max\n");
  write("sys/fs/cgroup/job/step/memory.current", "1\n");
  EXPECT_EQ(hostRoom(), 60 * kMebi);
}

TEST_F(System, FirstVersionOfControlGroups) {
  write("proc/self/cgroup", "9:name=systemd:/\n4:cpu,memory:/box\n0::/\n");
  write("sys/fs/cgroup/memory/box/memory.limit_in_bytes", "20971520\n");
  write("sys/fs/cgroup/memory/box/memory.usage_in_bytes", "31457280\n");
  EXPECT_EQ(hostRoom(), 0);  // never below
  write("sys/fs/cgroup/memory/box/memory.stat", "total_inactive_file 20971520\n");
  EXPECT_EQ(hostRoom(), 10 * kMebi);
}

TEST(MemoryRoom, OfThisSystemIsPlausible) {
  const MemoryRoom room = memoryRoom();
  EXPECT_GT(room.host, kMebi);
  EXPECT_LT(room.host, std::int64_t{1} << 50);
}

TEST(MemoryRoom, AddressSpaceIsWhatTheLimitLeaves) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve terabytes";
#endif
  rlimit before{};
  getrlimit(RLIMIT_AS, &before);
  constexpr std::int64_t kLimit = std::int64_t{64} << 30;
  const rlimit limit{static_cast<rlim_t>(kLimit), before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
  const std::int64_t room = memoryRoom().process;
  setrlimit(RLIMIT_AS, &before);
  EXPECT_LT(room, kLimit);
  EXPECT_GT(room, kLimit - (std::int64_t{8} << 30));
}

TEST(ByteText, HasTwoDigitsThatMeanSomething) {
  EXPECT_EQ(byteText(0), "0 bytes");
  EXPECT_EQ(byteText(1023), "1023 bytes");
  EXPECT_EQ(byteText(1536), "1.5 KiB");
  EXPECT_EQ(byteText(700 * kMebi), "700 MiB");
  EXPECT_EQ(byteText(std::int64_t{5} << 40), "5.0 TiB");
}

}  // namespace
}  // namespace burin
