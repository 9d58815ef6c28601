// readSlabs on any number of ranks: every voxel of every request once, memory bound kept, failures
// ending on all ranks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "burin/node/survey.hpp"
#include "support/array_source.hpp"
#include "support/mpi_test.hpp"

namespace burin::test {
namespace {

using node::Slab;
using testing::HasSubstr;

constexpr glm::ivec3 kDims{13, 9, 21};
constexpr std::size_t kSliceBytes = 13 * 9 * 2;

std::uint16_t voxelValue(const glm::ivec3& i) {
  return static_cast<std::uint16_t>(i.x + 50 * i.y + 1000 * i.z);
}

/// A volume in memory that may act as a stream: then it insists on whole slabs in ascending z.
class TestSource : public ArraySource {
 public:
  explicit TestSource(bool isStream)
      : ArraySource{ArraySource::of<std::uint16_t>(gridOf(), node::VoxelType::kU16, voxelValue)},
        isStream_{isStream} {}

  bool randomAccess() const override { return !isStream_; }
  void load(const IndexBox& region, std::span<std::byte> out) override {
    if (isStream_) {
      EXPECT_TRUE(world().isRoot()) << "only the root reads a stream";
      EXPECT_EQ(region.size().x, kDims.x);
      EXPECT_EQ(region.size().y, kDims.y);
      EXPECT_GE(region.lo.z, next_);
      next_ = region.hi.z;
    }
    if (region.hi.z > failFrom) fail(ExitCode::kVolume, "voxels from slice {} on", failFrom);
    largest = std::max(largest, out.size());
    ArraySource::load(region, out);
  }

  int failFrom = kDims.z;   ///< the first slice that cannot be read
  std::size_t largest = 0;  ///< bytes in one load

 private:
  static VolumeGrid gridOf() {
    VolumeGrid grid;
    grid.dims = kDims;
    return grid;
  }
  bool isStream_;
  int next_ = 0;
};

/// Boxes of a rank: a share of the slices with ghosts, overlapping random boxes, an empty one; more
/// of them on higher ranks.
std::vector<IndexBox> boxesOf(int rank, int ranks) {
  std::mt19937 random{static_cast<unsigned>(100 * ranks + rank)};
  const int first = kDims.z * rank / ranks;
  const int last = kDims.z * (rank + 1) / ranks;
  std::vector<IndexBox> boxes{
      {{0, 0, std::max(first - 1, 0)}, {kDims.x, kDims.y, std::min(last + 1, kDims.z)}}, {}};
  for (int n = 0; n < rank; ++n) {
    IndexBox box;
    for (int axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(random() % static_cast<unsigned>(kDims[axis]));
      const int b = static_cast<int>(random() % static_cast<unsigned>(kDims[axis]));
      box.lo[axis] = std::min(a, b);
      box.hi[axis] = std::max(a, b) + 1;
    }
    boxes.push_back(box);
  }
  return boxes;
}

int rankNumber() {
  return static_cast<int>(world().rank());
}

void expectSlabValues(const Slab& slab) {
  std::size_t at = 0;
  for (int k = slab.box.lo.z; k < slab.box.hi.z; ++k)
    for (int j = slab.box.lo.y; j < slab.box.hi.y; ++j)
      for (int i = slab.box.lo.x; i < slab.box.hi.x; ++i, at += 2) {
        std::uint16_t voxel = 0;
        std::memcpy(&voxel, slab.voxels.data() + at, sizeof voxel);
        ASSERT_EQ(voxel, voxelValue({i, j, k}));
      }
}

class ReadSlabs : public testing::TestWithParam<bool> {
 protected:
  /// Reads and checks this rank's boxes.
  static void expectAllDelivered(TestSource& source, std::size_t slabBytes) {
    const auto boxes = boxesOf(rankNumber(), world().size());
    std::vector<int> next;
    for (const IndexBox& box : boxes) next.push_back(box.lo.z);
    node::readSlabs(
        world(), source, boxes,
        [&](const Slab& slab) {
          ASSERT_LT(slab.request, boxes.size());
          const IndexBox& box = boxes[slab.request];
          EXPECT_EQ(slab.box.lo, glm::ivec3(box.lo.x, box.lo.y, next[slab.request]));
          EXPECT_EQ(glm::ivec2(slab.box.hi), glm::ivec2(box.hi));
          ASSERT_EQ(slab.voxels.size(), slab.box.count() * 2);
          EXPECT_LE(slab.voxels.size(), std::max(slabBytes, kSliceBytes));
          expectSlabValues(slab);
          next[slab.request] = slab.box.hi.z;
        },
        slabBytes);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (boxes[i].empty()) continue;
      EXPECT_EQ(next[i], boxes[i].hi.z);
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Access, ReadSlabs, testing::Values(false, true),
                         [](const auto& access) { return access.param ? "Stream" : "Random"; });

TEST_P(ReadSlabs, DeliversEveryVoxelOnce) {
  for (const std::size_t slabBytes : {std::size_t{1}, 3 * kSliceBytes, 100 * kSliceBytes}) {
    TestSource source{GetParam()};
    expectAllDelivered(source, slabBytes);
    EXPECT_LE(source.largest, std::max(slabBytes, kSliceBytes));
  }
}

TEST_P(ReadSlabs, NoRequestsAtAll) {
  TestSource source{GetParam()};
  node::readSlabs(world(), source, {}, [](const Slab&) { FAIL(); });
  EXPECT_EQ(source.largest, 0u);
}

/// What a read that must fail says, on this rank.
CollectiveError errorOf(TestSource& source, const std::function<void(const Slab&)>& deliver) {
  try {
    const auto boxes = boxesOf(rankNumber(), world().size());
    node::readSlabs(world(), source, boxes, deliver, 2 * kSliceBytes);
  } catch (const CollectiveError& error) {
    return error;
  }
  return {ExitCode::kDone, "nothing failed", Rank{-1}, ""};
}

TEST_P(ReadSlabs, AReadFailureEndsOnAllRanks) {
  for (const int failFrom : {0, 7, kDims.z - 1}) {
    TestSource source{GetParam()};
    source.failFrom = failFrom;
    const auto error = errorOf(source, [](const Slab&) {});
    EXPECT_EQ(error.code(), ExitCode::kVolume);
    EXPECT_THAT(error.what(), HasSubstr("voxels from slice"));
    if (GetParam()) {
      EXPECT_EQ(error.culprit(), Rank{0});
    }
    // No message of the failed read may be left for the next one.
    TestSource good{GetParam()};
    expectAllDelivered(good, 2 * kSliceBytes);
  }
}

TEST_P(ReadSlabs, ACallbackFailureOnAnyRankEndsOnAllRanks) {
  for (int culprit = 0; culprit < world().size(); ++culprit) {
    TestSource source{GetParam()};
    int slabs = 0;
    const auto error = errorOf(source, [&](const Slab&) {
      if (rankNumber() == culprit && ++slabs == 2) fail(ExitCode::kRank, "no room for a slab");
    });
    EXPECT_EQ(error.culprit(), Rank{culprit});
    EXPECT_EQ(error.code(), ExitCode::kRank);
    EXPECT_THAT(error.what(), HasSubstr("no room for a slab"));
    TestSource good{GetParam()};
    expectAllDelivered(good, 2 * kSliceBytes);
  }
}

}  // namespace
}  // namespace burin::test
