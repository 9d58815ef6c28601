// The fuzz targets in small, without guidance and sanitizers: seeds as the targets have them
// (write_seeds.py), damaged a little.
#include "fed_inputs.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "../node/written_volumes.hpp"
#include "support/temporary_folder.hpp"

namespace burin::test {
namespace {

namespace fs = std::filesystem;

/// Seeds out of the volumes that write_volumes.py wrote.
struct Seeds {
  Seeds() {
    const std::string command =
        fmt::format("/usr/bin/python3 '{}' '{}' '{}' > '{}' 2>&1", BURIN_WRITE_SEEDS,
                    folder.path().string(), written().folder.path().string(), folder / "log.txt");
    areThere = std::system(command.c_str()) == 0;
  }
  template <typename Use>
  void forEach(const FedInput& input, Use&& use) const {
    for (const auto& entry : fs::directory_iterator{folder.path() / input.name}) use(entry.path());
  }
  TemporaryFolder folder;
  bool areThere = false;
};

const Seeds& seeds() {
  static const Seeds all;
  return all;
}

class FedInputs : public testing::Test {
 protected:
  void SetUp() override {
    if (contentOf(written().folder.path() / "missing.txt") != "") {
      skipIfWritersAreMissing();
    } else {
      ASSERT_TRUE(seeds().areThere) << contentOf(seeds().folder.path() / "log.txt");
    }
  }
};

TEST_F(FedInputs, SeedsAreAccepted) {
  for (const FedInput& input : fedInputs()) {
    int count = 0;
    seeds().forEach(input, [&](const fs::path& seed) {
      EXPECT_EQ(feed(input, seed.string()), "") << seed;
      ++count;
    });
    EXPECT_GT(count, 0) << input.name;
  }
}

// feed() throws at anything but one clear line, and libraries keep theirs to themselves.
TEST_F(FedInputs, DamageIsReadOrRefused) {
#ifndef __SANITIZE_ADDRESS__  // whose reports would go the same way
  testing::internal::CaptureStderr();
#endif
  const TemporaryFolder folder;
  std::mt19937 random{11};
  for (const FedInput& input : fedInputs()) {
    int refused = 0;
    seeds().forEach(input, [&](const fs::path& seed) {
      const std::string whole = contentOf(seed);
      const std::string name = std::string{"damaged"} + input.extension;
      for (int trial = 0; trial < 24; ++trial) {
        std::string damaged = whole;
        // Headers lie in the first bytes, or anywhere in a short file.
        const std::size_t header = std::min<std::size_t>(whole.size(), 800);
        for (int i = 0; i <= trial % 4; ++i)
          damaged[random() % header] = static_cast<char>(random());
        if (trial % 3 == 0) damaged.resize(random() % whole.size());
        EXPECT_NO_THROW(refused += feed(input, folder.write(name, damaged)).empty() ? 0 : 1)
            << seed << ", trial " << trial;
      }
    });
    // A name that is none is no error, so nothing is refused there.
    const bool canBeRefused = input.name != std::string_view{"raw_name"};
    EXPECT_TRUE(!canBeRefused || refused > 10) << input.name;
  }
#ifndef __SANITIZE_ADDRESS__
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
#endif
}

}  // namespace
}  // namespace burin::test
