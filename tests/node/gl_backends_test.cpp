// Contexts of OSMesa and of EGL: the same pictures, in one process, in turns.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "burin/common/error.hpp"
#include "burin/node/offscreen_context.hpp"
#include "gl.hpp"
#include "node/layer_modes.hpp"
#include "support/drawing.hpp"
#include "support/mpi_test.hpp"
#include "support/scenes.hpp"

namespace burin::node {
namespace {

using test::ArraySource;
using test::difference;
using test::drawAlone;

class Context : public ::testing::TestWithParam<GlBackend> {};

TEST_P(Context, IsCoreProfile45) {
  const OffscreenContext context{{0, GetParam()}};
  EXPECT_THAT(context.description().version, ::testing::HasSubstr("4.5 (Core Profile)"));
  EXPECT_FALSE(context.description().renderer.empty());
  EXPECT_GE(context.description().largest3dTexture, 2048);
  EXPECT_NE(gl().GetString(GL_VENDOR), nullptr);
  EXPECT_NO_THROW(checkGl("asking for the vendor"));
}

/// A texture's one pixel.
float pixelOf(const Texture& texture) {
  float value = 0;
  gl().GetTextureImage(texture.id(), 0, GL_RED, GL_FLOAT, sizeof value, &value);
  return value;
}

Texture pixel(float value) {
  Texture texture = makeTexture(GL_TEXTURE_2D);
  gl().TextureStorage2D(texture.id(), 1, GL_R32F, 1, 1);
  gl().TextureSubImage2D(texture.id(), 0, 0, 0, 1, 1, GL_RED, GL_FLOAT, &value);
  return texture;
}

/// Contexts of both kinds have names of their own, and one that goes away leaves the others.
TEST_P(Context, StandsBesideOthers) {
  const GlBackend other = GetParam() == GlBackend::kEgl ? GlBackend::kOsMesa : GlBackend::kEgl;
  OffscreenContext first{{0, GetParam()}};
  Texture of1 = pixel(1);
  {
    OffscreenContext second{{0, GetParam()}};
    OffscreenContext third{{0, other}};
    const Texture of3 = pixel(3);
    second.makeCurrent();
    Texture of2 = pixel(2);
    first.makeCurrent();
    EXPECT_EQ(pixelOf(of1), 1);
    second.makeCurrent();
    EXPECT_EQ(pixelOf(of2), 2);
    of2 = Texture{};
    third.makeCurrent();
    EXPECT_EQ(pixelOf(of3), 3);
  }
  first.makeCurrent();
  EXPECT_EQ(pixelOf(of1), 1);
  EXPECT_NO_THROW(checkGl("reading pixels"));
}

INSTANTIATE_TEST_SUITE_P(Backends, Context, ::testing::Values(GlBackend::kOsMesa, GlBackend::kEgl));

/// llvmpipe behind both: the shaders are the same, and so should their arithmetic be.
void expectTheSamePicture(Scene scene, ArraySource& source, WorkerOptions options) {
  scene.imageSize = {36, 28};
  scene = test::resolved(scene, source);
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const auto draw = [&](GlBackend backend, RankStatistics& counted) {
    options.gl = backend;
    return drawAlone(scene, source, camera, options, &counted);
  };
  RankStatistics ofOsMesa, ofEgl;
  const Image<Rgba> expected = draw(GlBackend::kOsMesa, ofOsMesa);
  EXPECT_GT(test::largestAlpha(expected), 0.1);
  const test::Difference difference = test::difference(draw(GlBackend::kEgl, ofEgl), expected);
  EXPECT_LE(difference.largest, 1e-6);
  EXPECT_TRUE(difference.finite);
  EXPECT_EQ(ofEgl.samplesVisited, ofOsMesa.samplesVisited);
  EXPECT_EQ(ofEgl.samplesShaded, ofOsMesa.samplesShaded);
}

ArraySource backendVolume() {
  return test::smoothVolume(test::gridOf({30, 26, 22}, {1, 1, 1.3}));
}

class BackendStyle : public ::testing::TestWithParam<std::string> {};

TEST_P(BackendStyle, DrawsTheSamePicture) {
  ArraySource source = backendVolume();
  expectTheSamePicture(test::sceneWithStyle(GetParam()), source,
                       {.bricks = 2, .countSamples = true});
}

INSTANTIATE_TEST_SUITE_P(Styles, BackendStyle, ::testing::ValuesIn(test::drawnStyles()),
                         [](const auto& style) { return style.param; });

Scene labelledLight() {
  Scene scene = test::sceneWithStyle("light");
  scene.layers[0].labels = {1, 2};
  return scene;
}

Scene toneOfMiddles() {
  Scene scene = test::sceneWithStyle("tone");
  scene.quality.preintegrated = false;
  return scene;
}

Scene halvingLight() {
  Scene scene = test::sceneWithStyle("light");
  scene.quality.maxError = 0.02;
  return scene;
}

/// A surface is looked for in each cell.
Scene surfaceByCells() {
  Scene scene = test::isoScene("alone");
  scene.quality.maxError = 0.02;
  return scene;
}

/// What scenes of one style leave out, and how it is drawn.
struct DrawnWay {
  const char* name;
  Scene (*scene)();
  Technique technique = Technique::kRaycast;
  Precision precision = Precision::kFloat;
};

void PrintTo(const DrawnWay& way, std::ostream* out) {
  *out << way.name;
}

class BackendWay : public ::testing::TestWithParam<DrawnWay> {};

TEST_P(BackendWay, DrawsTheSamePicture) {
  ArraySource source = backendVolume();
  ArraySource labels = ArraySource::of<std::uint8_t>(
      source.info().grid, VoxelType::kU8,
      [](glm::ivec3 i) { return static_cast<std::uint8_t>((i.x / 6 + i.y / 7 + i.z / 5) % 3); });
  WorkerOptions options{.bricks = 2, .countSamples = true, .labels = &labels};
  options.technique = GetParam().technique;
  options.precision = GetParam().precision;
  expectTheSamePicture(GetParam().scene(), source, options);
}

INSTANTIATE_TEST_SUITE_P(
    Ways, BackendWay,
    ::testing::Values(DrawnWay{"Slices", labelledLight, Technique::kSlices},
                      DrawnWay{"SlicesInHalf", labelledLight, Technique::kSlices, Precision::kHalf},
                      DrawnWay{"SlicesInBytes", labelledLight, Technique::kSlices,
                               Precision::kByte},
                      DrawnWay{"Labels", labelledLight}, DrawnWay{"Middles", toneOfMiddles},
                      DrawnWay{"AllModes", test::sceneOfAllModes},
                      DrawnWay{"Halving", halvingLight}, DrawnWay{"ByCells", surfaceByCells}),
    [](const auto& way) { return std::string{way.param.name}; });

}  // namespace
}  // namespace burin::node
