#include <gtest/gtest.h>

#include "../compositor/random_pixels.hpp"
#include "tile_messages.hpp"

namespace burin::compositor::fuzz {
namespace {

// What the fuzzer starts from is what it should be: accepted, and nothing lost.
TEST(TileMessageSeeds, CarryWhatWasEncoded) {
  for (const Seed& seed : tileMessageSeeds()) {
    const auto walked = walkTileMessage(seed.bytes);
    ASSERT_TRUE(walked.has_value()) << seed.name;
    EXPECT_EQ(walked->tiles, seed.content.tiles) << seed.name;
    EXPECT_EQ(walked->active, seed.content.active) << seed.name;
  }
}

TEST(TileMessageSeeds, AreRefusedAtEveryOtherLength) {
  for (const Seed& seed : tileMessageSeeds()) {
    // Misaligned, it is the same message: some lengths of it.
    const std::size_t step = seed.name.find("_misaligned") == std::string::npos ? 1 : 7;
    for (std::size_t length = 0; length < seed.bytes.size(); length += step) {
      ASSERT_FALSE(walkTileMessage(std::span{seed.bytes}.first(length)))
          << seed.name << " cut to " << length;
    }
    auto longer = seed.bytes;
    longer.push_back({});
    ASSERT_FALSE(walkTileMessage(longer)) << seed.name;
  }
}

// The fuzzer in small, without its guidance: no sanitizer, no crash and no tile outside the frame.
TEST(TileMessageSeeds, SurviveDamage) {
  test::Random random{11};
  int refused = 0;
  int accepted = 0;
  for (const Seed& seed : tileMessageSeeds()) {
    for (int trial = 0; trial < 60; ++trial) {
      auto damaged = seed.bytes;
      for (int i = 0; i <= trial % 3; ++i) {
        const auto place =
            static_cast<std::size_t>(test::below(random, static_cast<int>(damaged.size())));
        damaged[place] = static_cast<std::byte>(random());
      }
      ++(walkTileMessage(damaged) ? accepted : refused);
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(accepted, 100);  // only pixels changed
}

}  // namespace
}  // namespace burin::compositor::fuzz
