#include "label_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace burin::host {
namespace {

/// 8³ blocks of 4³ cells with these labels; as many voxels of each label as it has blocks.
node::LabelSurvey surveyOf(const std::function<std::vector<int>(const glm::ivec3&)>& labels) {
  node::LabelSurvey survey;
  for (int z = 0; z < 8; ++z)
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) {
        node::LabelSet set = 0;
        for (const int label : labels({x, y, z})) {
          set |= node::labelSet(label);
          ++survey.voxels[label];
        }
        survey.blocks.push_back(set);
      }
  return survey;
}

Scene sceneOf(const node::LabelSurvey& survey) {
  VolumeFacts facts;
  facts.grid.dims = {33, 33, 33};
  VolumeChoice volume;
  volume.file = "head.nrrd";
  LabelVolumeChoice labels;
  labels.file = "seg.nrrd";
  return makeLabelScene(volume, labels, facts, {}, survey);
}

/// Per voxel.
double extinctionOf(const Scene& scene, const std::string& name) {
  for (const Layer& layer : scene.layers)
    if (layer.name == name)
      return layer.transferFunction.classify(0, *layer.transferFunction.opacityUnitLength)
          .extinction;
  ADD_FAILURE() << "no layer " << name;
  return 0;
}

TEST(LabelScene, OnlyWhatLiesAroundOthersIsClear) {
  // Shells of 1 around 2 around 3, and 4 apart.
  const Scene scene = sceneOf(surveyOf([](const glm::ivec3& block) -> std::vector<int> {
    if (block == glm::ivec3{7, 7, 7}) return {0, 4};
    const double radius = glm::length(glm::dvec3{block} - 3.0);
    if (radius < 1) return {2, 3};
    if (radius < 2) return {1, 2};
    if (radius < 4) return {0, 1};
    return {0};
  }));
  EXPECT_LT(extinctionOf(scene, "label 1"), 0.3);
  EXPECT_LT(extinctionOf(scene, "label 2"), 0.3);
  EXPECT_NEAR(extinctionOf(scene, "label 3"), 1, 1e-12);
  EXPECT_NEAR(extinctionOf(scene, "label 4"), 1, 1e-12);
}

TEST(LabelScene, SkinAroundAnOpenSkullIsClear) {
  // A neck that is cut off by the volume's lower face; skin and bone share nearly all blocks.
  const Scene scene = sceneOf(surveyOf([](const glm::ivec3& block) -> std::vector<int> {
    const glm::ivec3 fromAxis = glm::abs(2 * block - 7);
    const int away = std::max(fromAxis.x, fromAxis.y);
    if (block.z > 6 || away > 5) return {0};
    if (away > 3 || block.z > 5) return {0, 1};
    return {0, 1, 2};
  }));
  EXPECT_LT(extinctionOf(scene, "label 1"), 0.3);
  EXPECT_NEAR(extinctionOf(scene, "label 2"), 1, 1e-12);
  EXPECT_EQ(scene.camera.upAxis, "z");
}

TEST(LabelScene, ManyLabelsShareTheLastLayer) {
  // Label n in n blocks of its own.
  int label = 20, left = label;
  const Scene scene = sceneOf(surveyOf([&](const glm::ivec3&) -> std::vector<int> {
    if (left == 0) left = --label;
    if (label <= 0) return {0};
    --left;
    return {0, label};
  }));
  ASSERT_EQ(scene.layers.size(), static_cast<std::size_t>(kMostLabelLayers));
  EXPECT_EQ(scene.layers.front().labels, std::vector<LabelName>{20});
  std::vector<LabelName> rest;
  for (int n = 9; n > 0; --n) rest.emplace_back(n);
  EXPECT_EQ(scene.layers.back().labels, rest);
}

}  // namespace
}  // namespace burin::host
