#include "burin/host/default_scene.hpp"

#include <gtest/gtest.h>

namespace burin::host {
namespace {

VolumeChoice choice() {
  VolumeChoice volume;
  volume.file = "head.nrrd";
  return volume;
}

Scene sceneOf(const Histogram& histogram) {
  VolumeFacts facts;
  facts.grid.dims = {64, 64, 64};
  return makeDefaultScene(choice(), facts, histogram);
}

TEST(DefaultScene, IsAValidSceneThatComesBackFromItsText) {
  Histogram histogram;
  histogram.counts = {900, 950, 800, 0, 0, 0, 0, 40, 60, 30};
  const Scene scene = sceneOf(histogram);
  EXPECT_EQ(parseScene(writeScene(scene), "text"), scene);
  ASSERT_EQ(scene.layers.size(), 1u);
  EXPECT_NE(scene.layers[0].style("tone"), nullptr);
  EXPECT_NE(scene.layers[0].style("edges"), nullptr);
}

TEST(DefaultScene, HidesTheBackgroundAndShowsTheRest) {
  Histogram histogram;  // background in bins 0 … 2, things in 7 … 9
  histogram.counts = {900, 950, 800, 0, 0, 0, 0, 40, 60, 30};
  const TransferFunction function = sceneOf(histogram).layers[0].transferFunction;
  EXPECT_EQ(function.classify(2.9, 1).extinction, 0);
  EXPECT_GT(function.classify(7.0, 1).extinction, 0);
  EXPECT_GT(function.classify(9.5, 1).extinction, function.classify(7.0, 1).extinction);
}

TEST(DefaultScene, ConstantAndEmptyVolumesAreValidToo) {
  Histogram one;
  one.lowest = 5;
  one.counts = {27};
  EXPECT_NO_THROW(parseScene(writeScene(sceneOf(one)), "one value"));
  Histogram none;
  none.counts = {0};
  EXPECT_NO_THROW(parseScene(writeScene(sceneOf(none)), "no value"));
  Histogram tiny;  // a range of 1e-20
  tiny.binWidth = 1e-23;
  tiny.counts.assign(1000, 1);
  EXPECT_NO_THROW(parseScene(writeScene(sceneOf(tiny)), "tiny values"));
}

TEST(DefaultScene, LookDoesNotDependOnResolution) {
  Histogram histogram;
  histogram.counts = {900, 0, 100};
  VolumeFacts coarse, fine;
  coarse.grid.dims = {65, 65, 65};
  coarse.grid.spacing = {2, 2, 2};
  fine.grid.dims = {129, 129, 129};
  const Scene a = makeDefaultScene(choice(), coarse, histogram);
  const Scene b = makeDefaultScene(choice(), fine, histogram);
  EXPECT_EQ(a.layers[0].transferFunction, b.layers[0].transferFunction);
}

}  // namespace
}  // namespace burin::host
