// A worker whose bricks could not be loaded says so on every rank, draws nothing, and draws again
// once they can be.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "burin/common/communicator.hpp"
#include "support/drawing.hpp"
#include "support/mpi_test.hpp"
#include "support/scenes.hpp"

namespace burin::test {
namespace {

/// Loads fail on this rank from the given one on.
class FailingSource : public ArraySource {
 public:
  explicit FailingSource(const VolumeGrid& grid) : ArraySource{smoothVolume(grid)} {}

  void failAfter(int loads) { left_ = loads; }
  void work() { left_ = -1; }
  int loads() const { return loads_; }

  void load(const IndexBox& region, std::span<std::byte> out) override {
    if (left_ == 0) fail(ExitCode::kVolume, "array: out of order");
    if (left_ > 0) --left_;
    ++loads_;
    ArraySource::load(region, out);
  }

 private:
  int left_ = -1;
  int loads_ = 0;
};

Scene styledScene(const std::string& style, const node::BrickSource& source) {
  Scene scene = sceneWithStyle(style);
  scene.quality.preintegrated = style != "plain";  // so that another style needs more layers
  return resolved(scene, source);
}

TEST(FailingUpdate, IsOneErrorOnAllRanksAndCanBeRepeated) {
  FailingSource source{gridOf({30, 37, 26})};
  const Scene before = styledScene("plain", source);
  const Scene after = styledScene("light", source);
  const Camera camera = resolveCamera(after, {source.info().grid, false});
  node::Worker reference{world(), before, source, {}};
  const int loadsBefore = source.loads();
  reference.update(after);
  const int loads = source.loads() - loadsBefore;  // of this rank
  RankStatistics statistics;
  const Image<Rgba> expected = wholeFrame(reference.draw(camera, statistics));

  for (int broken = 0; broken < world().size(); ++broken) {
    const bool isBroken = static_cast<int>(world().rank()) == broken;
    // In the survey, and when bricks are read.
    for (const bool atTheEnd : {false, true}) {
      node::Worker worker{world(), before, source, {}};
      if (isBroken) source.failAfter(atTheEnd ? loads - 1 : 0);
      EXPECT_THROW(worker.update(after), CollectiveError) << broken << atTheEnd;
      EXPECT_TRUE(worker.visibilityOrder(camera).empty());
      EXPECT_TRUE(worker.draw(camera, statistics).active.empty());
      source.work();
      worker.update(after);
      const Image<Rgba> image = wholeFrame(worker.draw(camera, statistics));
      EXPECT_TRUE(std::ranges::equal(image.pixels(), expected.pixels())) << broken << atTheEnd;
    }
  }
}

}  // namespace
}  // namespace burin::test
