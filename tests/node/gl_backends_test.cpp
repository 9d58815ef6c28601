// Contexts of OSMesa and of EGL: the same pictures, in one process, in turns.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "burin/common/error.hpp"
#include "burin/node/offscreen_context.hpp"
#include "gl.hpp"
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

class BackendStyle : public ::testing::TestWithParam<std::string> {};

/// llvmpipe behind both: the shaders are the same, and so should their arithmetic be.
TEST_P(BackendStyle, DrawsTheSamePicture) {
  ArraySource source = test::smoothVolume(test::gridOf({30, 26, 22}, {1, 1, 1.3}));
  Scene scene = test::resolved(test::sceneWithStyle(GetParam()), source);
  scene.imageSize = {36, 28};
  const Camera camera = resolveCamera(scene, {source.info().grid, false});
  const auto draw = [&](GlBackend backend, RankStatistics& counted) {
    return drawAlone(scene, source, camera, {.bricks = 2, .countSamples = true, .gl = backend},
                     &counted);
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

INSTANTIATE_TEST_SUITE_P(Styles, BackendStyle, ::testing::ValuesIn(test::drawnStyles()),
                         [](const auto& style) { return style.param; });

}  // namespace
}  // namespace burin::node
