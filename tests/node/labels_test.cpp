// Layers that are bound to labels: closed forms, the reference, cuts, skipping, edits, failures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "burin/common/error.hpp"
#include "burin/node/label_volume.hpp"
#include "program_generator.hpp"
#include "support/against_reference.hpp"
#include "support/mpi_test.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

using node::VoxelType;
using testing::HasSubstr;
using testing::Not;

using Labelling = std::function<int(glm::ivec3)>;

ArraySource labelVolume(const VolumeGrid& grid, const Labelling& labelAt) {
  return ArraySource::of<std::uint8_t>(
      grid, VoxelType::kU8, [&](glm::ivec3 i) { return static_cast<std::uint8_t>(labelAt(i)); });
}

/// Blobs of the labels 1 to 5 with 0 between them, and a voxel of 6 by itself.
int blobs(glm::ivec3 i) {
  if (i == glm::ivec3{5, 6, 7}) return 6;
  const double wave = std::sin(0.7 * i.x + 0.3) + std::sin(0.6 * i.y) + std::cos(0.5 * i.z - 1);
  return wave < 0.4 ? 0 : 1 + (i.x / 5 + i.y / 7 + i.z / 6) % 5;
}

/// Counts how often it is asked for voxels; may fail, or deliver nothing that is a label.
class WatchedSource : public node::BrickSource {
 public:
  explicit WatchedSource(node::BrickSource& inner) : inner_{inner} {}
  const node::VolumeInfo& info() const override { return inner_.info(); }
  bool randomAccess() const override { return true; }
  void load(const IndexBox& region, std::span<std::byte> out) override {
    ++loads;
    if (fails) fail(ExitCode::kVolume, "labels are gone");
    inner_.load(region, out);
  }
  int loads = 0;
  bool fails = false;

 private:
  node::BrickSource& inner_;
};

Scene boundTo(Scene scene, std::vector<LabelName> labels, std::size_t layer = 0) {
  scene.layers[layer].labels = std::move(labels);
  return scene;
}

/// One homogeneous layer of extinction `sigma`, everywhere in a volume of 0.5, seen along -z.
Scene homogeneousScene(double sigma, bool preintegrated) {
  Scene scene = sceneWithStyle("plain");
  scene.layers[0].transferFunction = {{{0, {255, 255, 255}, -std::expm1(-sigma)}}, 1.0};
  scene.imageSize = {64, 64};
  scene.quality.preintegrated = preintegrated;
  scene.camera = {.azimuthDeg = 0, .elevationDeg = 0, .projection = Projection::kOrthographic};
  scene.camera.upAxis = "y";
  return scene;
}

// Labels of half the volume, x >= 8: along z a ray's membership is one number, known at each pixel.
TEST(Labels, AHalfSpaceIsItsClosedForm) {
  constexpr double kSigma = 0.05;
  const VolumeGrid grid = gridOf({17, 17, 17});
  ArraySource source{grid, [](glm::ivec3) { return 0.5f; }};
  ArraySource labels = labelVolume(grid, [](glm::ivec3 i) { return i.x >= 8 ? 3 : 0; });
  for (const bool preintegrated : {true, false}) {
    const Scene scene = resolved(boundTo(homogeneousScene(kSigma, preintegrated), {3}), source);
    const Camera camera = resolveCamera(scene, {grid, false});
    const Image<Rgba> image = drawAlone(scene, source, camera, {.labels = &labels});
    int between = 0;
    for (int column = 0; column < 64; ++column) {
      const double x = 8 + (column + 0.5 - 32) * camera.pixelSize;
      if (x < 0 || x > 16) continue;
      const double member = std::clamp(x - 7, 0.0, 1.0);
      between += member > 0 && member < 1 ? 1 : 0;
      // Of the table's extinction 1e-6, of some tens of sums in floats 1e-6 more.
      EXPECT_NEAR(image.at(column, 32).a, -std::expm1(-kSigma * 16 * member), 1e-5) << x;
      if (member == 0) {
        EXPECT_EQ(image.at(column, 32).a, 0) << x;
      }
    }
    EXPECT_GE(between, 1);
  }
}

// The border across the rays: half a voxel belongs to the layer outside of its voxels. The middle
// rule is exact on linear pieces; within h of each of the two kinks it misses at most h²/8 of the
// slope, 1.
TEST(Labels, ASmoothBorderConvergesInSecondOrder) {
  constexpr double kSigma = 0.05;
  const VolumeGrid grid = gridOf({9, 9, 17});
  ArraySource source{grid, [](glm::ivec3) { return 0.5f; }};
  ArraySource labels = labelVolume(grid, [](glm::ivec3 i) { return i.z >= 6 ? 1 : 0; });
  for (const double step : {1.7, 0.9, 0.45, 0.2}) {
    Scene scene = homogeneousScene(kSigma, true);
    scene.quality.stepVoxels = step;
    scene = resolved(boundTo(scene, {1}), source);
    const Camera camera = resolveCamera(scene, {grid, false});
    const Image<Rgba> image = drawAlone(scene, source, camera, {.labels = &labels});
    EXPECT_NEAR(-std::log1p(-image.at(32, 32).a) / kSigma, 10.5, step * step / 4 + 1e-3) << step;
  }
}

struct Case {
  const char* name;
  std::vector<std::string> styles;             ///< one for each layer
  std::vector<std::vector<LabelName>> labels;  ///< likewise
  bool preintegrated = true;
  node::Technique technique = node::Technique::kRaycast;
  std::optional<double> maxError = std::nullopt;
  bool hasNan = false;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"one", {"plain"}, {{1, 3, 6}}},
      {"middles", {"line_opacity"}, {{0, 2}}, false},
      {"two of three", {"light", "plain", "edges"}, {{1, 2}, {}, {2, 1, 4}}},
      {"slices", {"light", "line_opacity"}, {{1, 5}, {3, 4}}, true, node::Technique::kSlices},
      {"not valid", {"plain"}, {{1, 2, 4}}, true, node::Technique::kRaycast, {}, true},
      {"adaptive", {"plain"}, {{1, 2, 4}}, true, node::Technique::kRaycast, 0.01}};
  return all;
}

Scene sceneOf(const Case& one) {
  Scene scene = sceneWithStyle(one.styles[0]);
  for (std::size_t i = 1; i < one.styles.size(); ++i)
    scene.layers.push_back(sceneWithStyle(one.styles[i]).layers[0]);
  for (std::size_t i = 0; i < one.labels.size(); ++i) scene.layers[i].labels = one.labels[i];
  scene.imageSize = {40, 32};
  scene.quality.preintegrated = one.preintegrated;
  return scene;
}

class LabelCases : public testing::TestWithParam<Case> {
 protected:
  VolumeGrid grid_ = gridOf({20, 17, 22}, {1, 1.2, 0.9});
  ArraySource source_{grid_, [](glm::ivec3 i) {
                        if (GetParam().hasNan && i.x > 12 && i.y > 8) return std::nanf("");
                        return static_cast<float>(smoothField(glm::dvec3{i}));
                      }};
  ArraySource labels_ = labelVolume(grid_, blobs);
  Scene scene_ = resolved(sceneOf(GetParam()), source_);
  Camera camera_ = resolveCamera(scene_, {grid_, false});
  node::WorkerOptions options_{.technique = GetParam().technique, .labels = &labels_};
};

TEST_P(LabelCases, AgreeWithTheReference) {
  Scene asked = scene_;  // of the reference; the renderer marches as RaycastFrames lets it
  if (GetParam().maxError) {
    scene_.quality.maxError = asked.quality.maxError = GetParam().maxError;
    scene_.quality.stepVoxels = 1;
    asked.quality.maxError = 1e-4;
  }
  const Communicator self{MPI_COMM_SELF};
  node::Worker worker{self, scene_, source_, options_};
  RankStatistics statistics;
  const Image<Rgba> image = wholeFrame(worker.draw(camera_, statistics));
  EXPECT_GT(largestAlpha(image), 0.1);
  const node::ReferenceRenderer reference{asked, source_,
                                          node::surveyedScales(worker.survey(), asked), &labels_};
  std::vector<ReferencePixel> truth;
  for (const glm::dvec4& p : reference.render(camera_, 0, camera_.image.height, 1))
    truth.push_back({p.r, p.g, p.b, p.a});
  const Difference d = difference(image.pixels(), std::span<const ReferencePixel>{truth});
  EXPECT_TRUE(d.finite);
  EXPECT_LE(d.largest, GetParam().maxError ? *GetParam().maxError + 1e-4 : kReferenceBound);
}

TEST_P(LabelCases, DependOnNoCutAndOnNoSkipping) {
  if (GetParam().maxError) {
    scene_.quality.maxError = GetParam().maxError;
    scene_.quality.stepVoxels = 1;
  }
  std::optional<Image<Rgba>> whole;
  for (const int bricks : {1, 5}) {
    options_.bricks = bricks;
    options_.countSamples = true;
    RankStatistics on, off;
    options_.skip = true;
    const Image<Rgba> skipped = drawAlone(scene_, source_, camera_, options_, &on);
    options_.skip = false;
    const Image<Rgba> visited = drawAlone(scene_, source_, camera_, options_, &off);
    EXPECT_TRUE(std::ranges::equal(skipped.pixels(), visited.pixels())) << bricks;
    EXPECT_EQ(on.samplesShaded, off.samplesShaded) << bricks;
    EXPECT_LE(on.samplesVisited, off.samplesVisited) << bricks;
    if (!whole) whole = skipped;
    const Difference d = difference(skipped, *whole);
    EXPECT_LE(d.largest, 5e-5) << bricks;  // the bounds of brick_invariance_test.cpp
    EXPECT_LE(d.rms, 2e-6) << bricks;
  }
}

INSTANTIATE_TEST_SUITE_P(All, LabelCases, testing::ValuesIn(cases()),
                         [](const testing::TestParamInfo<Case>& one) {
                           std::string name = one.param.name;
                           std::erase(name, ' ');
                           return name;
                         });

// A small label in a large volume of which every voxel's value shows.
TEST(Labels, WhatNoLayerIsBoundToIsNeitherLoadedNorVisited) {
  const VolumeGrid grid = gridOf({65, 65, 65});
  ArraySource source{grid, [](glm::ivec3) { return 0.5f; }};
  ArraySource labels = labelVolume(grid, [](glm::ivec3 i) {
    return glm::all(glm::greaterThanEqual(i, glm::ivec3{28})) &&
                   glm::all(glm::lessThan(i, glm::ivec3{36}))
               ? 2
               : 0;
  });
  const Scene everywhere = resolved(homogeneousScene(0.02, true), source);
  const Scene bound = boundTo(everywhere, {2});
  const Camera camera = resolveCamera(everywhere, {grid, false});
  RankStatistics all, some, none;
  const node::WorkerOptions options{.countSamples = true, .labels = &labels};
  drawAlone(everywhere, source, camera, options, &all);
  drawAlone(bound, source, camera, options, &some);
  drawAlone(boundTo(everywhere, {7}), source, camera, options, &none);
  EXPECT_GT(some.samplesShaded, 0);
  // 8 voxels of label and one of border on each side, in macrocells of 4 with one around, of 64.
  EXPECT_LT(some.samplesVisited, all.samplesVisited / 30);
  // What is loaded goes by blocks of 4 cells with one around: 27³ of 65³ voxels with a byte more
  // each, and for each of 16³ blocks 17 bytes instead of 9.
  EXPECT_LT(some.residentVoxelBytes, all.residentVoxelBytes / 5);
  EXPECT_EQ(none.samplesVisited, 0);
}

// More masks than a byte has bits, and labels of all types.
TEST(Labels, ManyMasksAndAllTypes) {
  const VolumeGrid grid = gridOf({16, 9, 9});
  ArraySource source{grid, [](glm::ivec3) { return 0.5f; }};
  Scene scene = homogeneousScene(0.01, false);
  scene.imageSize = {24, 16};
  scene.layers.resize(12, scene.layers[0]);
  for (int i = 0; i < 12; ++i) scene.layers[static_cast<std::size_t>(i)].labels = {i - 2};
  scene = resolved(scene, source);
  const Camera camera = resolveCamera(scene, {grid, false});
  const auto labelAt = [](glm::ivec3 i) { return i.x - 2; };
  ArraySource i16 = ArraySource::of<std::int16_t>(
      grid, VoxelType::kI16, [&](glm::ivec3 i) { return static_cast<std::int16_t>(labelAt(i)); });
  ArraySource f32{grid, [&](glm::ivec3 i) { return static_cast<float>(labelAt(i)); }};
  const Image<Rgba> image = drawAlone(scene, source, camera, {.labels = &i16});
  // Labels cover x = 0 … 11 once each, so the layers' memberships add up to 1 there.
  EXPECT_NEAR(image.at(8, 8).a, -std::expm1(-0.01 * 8), 1e-5);
  EXPECT_TRUE(std::ranges::equal(image.pixels(),
                                 drawAlone(scene, source, camera, {.labels = &f32}).pixels()));
  ArraySource half{grid, [](glm::ivec3) { return 1.5f; }};
  try {
    drawAlone(scene, source, camera, {.labels = &half});
    ADD_FAILURE() << "1.5 is a label";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kVolume);
    EXPECT_THAT(error.what(), HasSubstr("1.5 is no label"));
  }
}

TEST(Labels, AnEditReadsOnlyWhatItNeeds) {
  const VolumeGrid grid = gridOf({20, 17, 22});
  ArraySource values = smoothVolume(grid);
  ArraySource blobVolume = labelVolume(grid, blobs);
  WatchedSource source{values}, labels{blobVolume};
  const Communicator self{MPI_COMM_SELF};
  const Scene plain = resolved(sceneWithStyle("plain"), source);
  const Camera camera = resolveCamera(plain, {grid, false});
  const node::WorkerOptions options{.wholeBricks = true, .labels = &labels};
  node::Worker worker{self, plain, source, options};
  EXPECT_EQ(labels.loads, 0) << "a scene without labels";
  const auto expectAsNew = [&](const Scene& scene) {
    RankStatistics statistics;
    EXPECT_TRUE(std::ranges::equal(
        wholeFrame(worker.draw(camera, statistics)).pixels(),
        drawAlone(scene, values, camera, {.wholeBricks = true, .labels = &blobVolume}).pixels()));
  };
  const int loaded = source.loads;
  for (const Scene& scene : {boundTo(plain, {1, 2}), boundTo(plain, {3}), plain}) {
    const int before = labels.loads;
    worker.update(scene);
    EXPECT_EQ(labels.loads > before, !scene.layers[0].labels.empty());
    expectAsNew(scene);
  }
  worker.update(boundTo(plain, {3}));
  const int before = labels.loads;
  Scene fainter = boundTo(plain, {3});
  for (TransferPoint& point : fainter.layers[0].transferFunction.points) point.opacity *= 0.5;
  worker.update(fainter);
  EXPECT_EQ(labels.loads, before) << "the labels are the same";
  expectAsNew(fainter);
  // Longer segments see labels from further away.
  Scene coarser = fainter;
  coarser.quality = {.stepVoxels = 1.9, .termination = 0};
  worker.update(coarser);
  expectAsNew(coarser);
  EXPECT_EQ(source.loads, loaded) << "the voxels are the same";
}

TEST(Labels, ASceneWithoutThemIsDrawnAsEver) {
  for (const bool isBound : {false, true}) {
    const Scene scene = boundTo(sceneWithStyle("all"),
                                isBound ? std::vector<LabelName>{1} : std::vector<LabelName>{});
    const std::string text = node::generateRaycastProgram(scene, {}).text;
    for (const char* name : {"LABELS\n#define", "prepareLabels", "membership", "mask0"})
      EXPECT_THAT(text, isBound ? testing::Matcher<const std::string&>(HasSubstr(name))
                                : testing::Matcher<const std::string&>(Not(HasSubstr(name))))
          << name;
    EXPECT_EQ(text, node::generateRaycastProgram(boundTo(scene, scene.layers[0].labels.empty()
                                                                    ? std::vector<LabelName>{}
                                                                    : std::vector<LabelName>{4, 5}),
                                                 {})
                        .text);
    EXPECT_EQ(ghostLayersNeeded(scene), ghostLayersNeeded(sceneWithStyle("all")));
  }
  const VolumeGrid grid = gridOf({20, 17, 22});
  ArraySource source = smoothVolume(grid);
  ArraySource labels = labelVolume(grid, blobs);
  const Scene scene = resolved(sceneWithStyle("plain"), source);
  const Camera camera = resolveCamera(scene, {grid, false});
  RankStatistics without, with, bound;
  drawAlone(scene, source, camera, {}, &without);
  drawAlone(scene, source, camera, {.labels = &labels}, &with);
  EXPECT_EQ(with.residentVoxelBytes, without.residentVoxelBytes);
  drawAlone(boundTo(scene, {0, 1, 2, 3, 4, 5, 6}), source, camera, {.labels = &labels}, &bound);
  EXPECT_GE(bound.residentVoxelBytes,
            without.residentVoxelBytes + static_cast<std::int64_t>(grid.voxelCount()));
}

// On every rank of the world: a rank that cannot read the labels fails all of them, in an update
// too.
TEST(Labels, LabelsThatCannotBeReadFailAllRanks) {
  const VolumeGrid grid = gridOf({20, 17, 22});
  ArraySource source = smoothVolume(grid);
  ArraySource blobVolume = labelVolume(grid, blobs);
  WatchedSource labels{blobVolume};
  const Scene plain = resolved(sceneWithStyle("plain"), source);
  const Camera camera = resolveCamera(plain, {grid, false});
  node::Worker worker{world(), boundTo(plain, {1}), source, {.labels = &labels}};
  labels.fails = static_cast<int>(world().rank()) == world().size() - 1;
  try {
    worker.update(boundTo(plain, {1, 2}));
    ADD_FAILURE() << "labels were not read";
  } catch (const CollectiveError& error) {
    EXPECT_THAT(error.what(), HasSubstr("labels are gone"));
    EXPECT_EQ(error.code(), ExitCode::kVolume);
  }
  labels.fails = false;
  worker.update(boundTo(plain, {1, 2}));
  RankStatistics statistics;
  EXPECT_FALSE(worker.draw(camera, statistics).active.empty());
}

TEST(LabelSurvey, CountsAndBlocksAreThoseOfTheVoxels) {
  const VolumeGrid grid = gridOf({20, 17, 22});
  ArraySource labels = labelVolume(grid, blobs);
  const node::LabelSurvey survey = node::surveyLabels(world(), labels);
  std::map<int, std::int64_t> counts;
  const glm::ivec3 blocks = (grid.cells() + 3) / 4;
  std::vector<node::LabelSet> sets(IndexBox{glm::ivec3{0}, blocks}.count());
  for (int k = 0; k < 22; ++k)
    for (int j = 0; j < 17; ++j)
      for (int i = 0; i < 20; ++i) {
        ++counts[blobs({i, j, k})];
        for (std::size_t b = 0; b < sets.size(); ++b) {
          const int n = static_cast<int>(b);
          const glm::ivec3 lo =
              4 * glm::ivec3{n % blocks.x, n / blocks.x % blocks.y, n / blocks.x / blocks.y};
          const glm::ivec3 at = glm::ivec3{i, j, k} - lo;
          if (glm::all(glm::greaterThanEqual(at, glm::ivec3{0})) &&
              glm::all(glm::lessThanEqual(at, glm::ivec3{4})))
            sets[b] |= node::labelSet(blobs({i, j, k}));
        }
      }
  EXPECT_EQ(survey.voxels, counts);
  EXPECT_EQ(survey.blocks, sets);
}

TEST(LabelVolume, AnotherGridIsRefusedByWhatDiffers) {
  node::VolumeInfo volume;
  volume.name = "head.nrrd";
  volume.grid = gridOf({10, 11, 12}, {1, 1, 2});
  const auto complaint = [&](const std::function<void(VolumeGrid&)>& change) -> std::string {
    node::VolumeInfo labels = volume;
    labels.name = "seg.nrrd";
    change(labels.grid);
    try {
      node::checkLabelVolume(volume, labels);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::kVolume);
      return error.what();
    }
    return "";
  };
  const std::string start =
      "head.nrrd and its labels seg.nrrd must have the same grid, but differ: ";
  EXPECT_EQ(complaint([](VolumeGrid& g) { g.dims.y = 12; }),
            start + "10 x 11 x 12 and 10 x 12 x 12 voxels");
  EXPECT_EQ(complaint([](VolumeGrid& g) { g.spacing.z = 1; }), start + "spacing 1 1 2 and 1 1 1");
  EXPECT_EQ(complaint([](VolumeGrid& g) { g.origin.x = 0.5; }), start + "origin 0 0 0 and 0.5 0 0");
  EXPECT_EQ(complaint([](VolumeGrid& g) { g.direction[0].x = -1; }),
            start + "direction of x 1 0 0 and -1 0 0");
  // As a header in single precision says them.
  EXPECT_EQ(complaint([](VolumeGrid& g) {
              g.origin.x = 1e-4;
              g.spacing.z = 2.00001;
            }),
            "");
}

}  // namespace
}  // namespace burin::test
