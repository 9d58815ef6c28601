// Loading, uploading, compiling and drawing fail on each rank in turn: the same error on all ranks,
// which names that rank, and the ranks still understand each other afterwards. Failures are put
// into the volume and into the table of OpenGL's functions, where real ones would come from.

#include <glad/gl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "burin/compositor/compositor.hpp"
#include "burin/compositor/over_half.hpp"
#include "burin/host/frame_maker.hpp"
#include "burin/node/worker.hpp"
#include "gl.hpp"
#include "support/drawing.hpp"
#include "support/mpi_test.hpp"
#include "support/scenes.hpp"

namespace burin::host {
namespace {

using test::ArraySource;
using test::world;
using ::testing::HasSubstr;

/// The function table that this rank draws with, or nullptr while it has no context.
GladGLContext* glTable() {
  try {
    return const_cast<GladGLContext*>(&node::gl());
  } catch (const std::logic_error&) {
    return nullptr;
  }
}

/// Calls `onLoad` before every load on this rank.
class WatchedSource : public ArraySource {
 public:
  explicit WatchedSource(std::function<void()> onLoad)
      : ArraySource{test::smoothVolume(test::gridOf({24, 20, 28}))}, onLoad_{std::move(onLoad)} {}
  void load(const IndexBox& region, std::span<std::byte> out) override {
    onLoad_();
    ArraySource::load(region, out);
  }

 private:
  std::function<void()> onLoad_;
};

PreparedScene prepared(std::function<void()> onLoad = [] {}) {
  PreparedScene prepared;
  prepared.source = std::make_unique<WatchedSource>(std::move(onLoad));
  prepared.facts = {prepared.source->info().grid, false};
  prepared.scene = test::resolved(test::sceneWithStyle("light"), *prepared.source);
  return prepared;
}

Camera cameraOf(const PreparedScene& scene) {
  return resolveCamera(scene.scene, scene.facts);
}

template <typename Work>
void expectFailureOf(int rank, const std::string& says, Work&& work) {
  try {
    work();
    ADD_FAILURE() << "nobody heard of the failure of rank " << rank;
  } catch (const CollectiveError& error) {
    EXPECT_EQ(error.culprit(), Rank{rank});
    EXPECT_THAT(error.what(), HasSubstr(says));
  }
  barrier(world());  // nobody was left behind
}

template <typename Test>
void onEachRankInTurn(Test&& test) {
  for (int culprit = 0; culprit < world().size(); ++culprit) {
    SCOPED_TRACE(culprit);
    test(culprit, world().rank() == Rank{culprit});
  }
}

TEST(FailingPhase, Survey) {
  onEachRankInTurn([](int culprit, bool isMe) {
    PreparedScene scene = prepared([&] {
      if (isMe) fail(ExitCode::kVolume, "array: out of order");
    });
    expectFailureOf(culprit, "out of order", [&] { makeRaycastFrames(world(), scene, {}, {}); });
  });
}

/// Bricks are loaded when there is a context, the survey before. Failed frame makers of earlier
/// ranks have taken theirs along.
TEST(FailingPhase, Load) {
  onEachRankInTurn([](int culprit, bool isMe) {
    PreparedScene scene = prepared([&] {
      if (isMe && glTable() != nullptr) fail(ExitCode::kVolume, "array: out of order");
    });
    expectFailureOf(culprit, "out of order", [&] { makeRaycastFrames(world(), scene, {}, {}); });
  });
}

void GLAD_API_PTR refuseVoxels(GLuint, GLint, GLint, GLint, GLint, GLsizei, GLsizei, GLsizei,
                               GLenum, GLenum, const void*) {
  node::gl().Enable(GL_INVALID_ENUM);  // any error will do
}

TEST(FailingPhase, Upload) {
  onEachRankInTurn([](int culprit, bool isMe) {
    PreparedScene scene = prepared([&] {
      if (isMe && glTable() != nullptr) glTable()->TextureSubImage3D = refuseVoxels;
    });
    expectFailureOf(culprit, "uploading voxels",
                    [&] { makeRaycastFrames(world(), scene, {}, {}); });
  });
}

void GLAD_API_PTR failToCompile(GLuint, GLenum, GLint* result) {
  *result = GL_FALSE;
}

TEST(FailingPhase, Compile) {
  onEachRankInTurn([](int culprit, bool isMe) {
    PreparedScene scene = prepared();
    node::Worker worker{world(), scene.scene, *scene.source, {}};
    Scene other = test::resolved(test::sceneWithStyle("edges"), *scene.source);
    other.quality = scene.scene.quality;
    const auto compiled = glTable()->GetShaderiv;
    if (isMe) glTable()->GetShaderiv = failToCompile;
    expectFailureOf(culprit, "does not compile", [&] { worker.update(other); });
    glTable()->GetShaderiv = compiled;
    EXPECT_NO_THROW(worker.update(other));
  });
}

void GLAD_API_PTR refuseToDraw(GLenum, GLint, GLsizei) {
  node::gl().Enable(GL_INVALID_ENUM);
}

/// The frame is lost on all ranks; the next one is whole.
TEST(FailingPhase, Draw) {
  PreparedScene scene = prepared();
  const auto frames = makeRaycastFrames(world(), scene, {}, {});
  const Camera camera = cameraOf(scene);
  RankStatistics statistics;
  const auto pixelsNow = [&] {
    const auto pixels = frames->make(camera, statistics).pixels();
    return std::vector<Rgba>{pixels.begin(), pixels.end()};
  };
  const std::vector<Rgba> expected = pixelsNow();
  EXPECT_EQ(expected.empty(), !world().isRoot());
  const auto drawn = glTable()->DrawArrays;
  onEachRankInTurn([&](int culprit, bool isMe) {
    if (isMe) glTable()->DrawArrays = refuseToDraw;
    expectFailureOf(culprit, "drawing: OpenGL", [&] { pixelsNow(); });
    glTable()->DrawArrays = drawn;
    EXPECT_TRUE(pixelsNow() == expected);
  });
}

/// Memory that ranks would hand their pixels over in.
TEST(FailingPhase, ReadBack) {
  PreparedScene scene = prepared();
  const Camera camera = cameraOf(scene);
  onEachRankInTurn([&](int culprit, bool isMe) {
    node::Worker worker{world(), scene.scene, *scene.source, {}};
    compositor::Compositor compositor{world()};
    RankStatistics statistics;
    const auto room = [&](std::size_t pixels) {
      if (isMe) throw std::bad_alloc{};
      return compositor.canvas<Rgba>(camera.image, pixels);
    };
    compositor::SubimageView<Rgba> mine{camera.image, {}, {}};
    Outcome drawing = attempt([&] { mine = worker.draw(camera, statistics, room); });
    expectFailureOf(culprit, "bad_alloc", [&] {
      compositor.toRoot<compositor::Over>({}, worker.visibilityOrder(camera), mine,
                                          std::move(drawing), statistics);
    });
  });
}

}  // namespace
}  // namespace burin::host
