#include "burin/host/default_scene.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "burin/common/named_style.hpp"

namespace burin::host {
namespace {

VolumeChoice choice() {
  VolumeChoice volume;
  volume.file = "head.nrrd";
  return volume;
}

/// A profile with these counts and no gradients, and one block of all values.
struct Known {
  MaterialProfile profile;
  node::BlockRanges blocks;
};

Known known(std::vector<std::int64_t> counts, double lowest = 0, double binWidth = 1) {
  Known made;
  made.profile.histogram.lowest = lowest;
  made.profile.histogram.binWidth = binWidth;
  made.profile.gradientSums.resize(counts.size());
  made.profile.squareSums.resize(counts.size());
  made.profile.magnitudeCounts.resize(1);
  made.blocks.blocks = {1, 1, 1};
  made.blocks.lowest = {static_cast<float>(lowest)};
  made.blocks.highest = {
      static_cast<float>(lowest + binWidth * static_cast<double>(counts.size()))};
  made.profile.histogram.counts = std::move(counts);
  return made;
}

Scene sceneOf(const Known& volume, const VolumeFacts& facts) {
  return makeDefaultScene(choice(), facts, volume.profile, volume.blocks);
}

Scene sceneOf(const Known& volume) {
  VolumeFacts facts;
  facts.grid.dims = {64, 64, 64};
  return sceneOf(volume, facts);
}

TEST(DefaultScene, IsAValidSceneThatComesBackFromItsText) {
  const Scene scene = sceneOf(known({900, 950, 800, 0, 0, 0, 0, 40, 60, 30}));
  EXPECT_EQ(parseScene(writeScene(scene), "text"), scene);
  ASSERT_EQ(scene.layers.size(), 1u);
}

TEST(DefaultScene, IsTheNamedStyleIllustration) {
  const auto styles = findNamedStyles({std::filesystem::path{BURIN_STYLES_DIR}});
  const auto found = std::find_if(styles.begin(), styles.end(),
                                  [](const NamedStyle& s) { return s.name == "illustration"; });
  ASSERT_NE(found, styles.end());
  std::vector<StyleSettings> effects = sceneOf(known({900, 0, 100})).layers[0].styles;
  std::erase_if(effects, [](const StyleSettings& s) { return s.name == "gradient"; });
  EXPECT_EQ(effects, found->effects);
}

TEST(DefaultScene, HidesTheBackgroundAndShowsTheRest) {
  // Background in bins 0 … 2, things in 7 … 9.
  const TransferFunction function =
      sceneOf(known({900, 950, 800, 0, 0, 0, 0, 40, 60, 30})).layers[0].transferFunction;
  EXPECT_EQ(function.classify(2.9, 1).extinction, 0);
  EXPECT_GT(function.classify(7.0, 1).extinction, 0);
  EXPECT_GT(function.classify(9.5, 1).extinction, function.classify(7.0, 1).extinction);
}

TEST(DefaultScene, ConstantAndEmptyVolumesAreValidToo) {
  const auto parse = [](const Known& volume) {
    return parseScene(writeScene(sceneOf(volume)), "text");
  };
  EXPECT_NO_THROW(parse(known({27}, 5)));
  EXPECT_NO_THROW(parse(known({0})));
  EXPECT_NO_THROW(parse(known(std::vector<std::int64_t>(1000, 1), 0, 1e-23)));
}

TEST(DefaultScene, LookDoesNotDependOnResolution) {
  const Known volume = known({900, 0, 100});
  VolumeFacts coarse, fine;
  coarse.grid.dims = {65, 65, 65};
  coarse.grid.spacing = {2, 2, 2};
  fine.grid.dims = {129, 129, 129};
  const Scene a = sceneOf(volume, coarse);
  const Scene b = sceneOf(volume, fine);
  EXPECT_EQ(a.layers[0].transferFunction, b.layers[0].transferFunction);
}

}  // namespace
}  // namespace burin::host
