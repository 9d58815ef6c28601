#include "burin/compositor/silhouette_depth.hpp"

#include <gtest/gtest.h>

#include "burin/compositor/silhouette.hpp"
#include "slice_rays.hpp"

namespace burin::compositor {
namespace {

using enum RayState;
using DeepSlices = std::vector<SliceSymbol>;
using Pixel = SilhouetteDepthPixel;

/// Every function; those that have a depth have `depth`.
std::vector<Pixel> everyPixel(float depth) {
  std::vector<Pixel> pixels;
  for (unsigned i = 0; i < SilhouetteDepth::kFunctions; ++i) {
    Pixel pixel{SilhouetteDepthCode(i), 0};
    if (SilhouetteDepth::hasDepth(pixel)) pixel.depth = depth;
    pixels.push_back(pixel);
  }
  return pixels;
}

/// Slice i has depth firstDepth + i.
Pixel deepSegment(const DeepSlices& slices, float firstDepth) {
  Pixel pixel = SilhouetteDepth::identity();
  float depth = firstDepth;
  for (const SliceSymbol symbol : slices) {
    pixel = SilhouetteDepth::combine(pixel, SilhouetteDepth::slice(symbol, depth));
    depth += 1;
  }
  return pixel;
}

/// A ray that came to the segment in state `before` leaves it so.
test::Walk walkAfter(const test::Walk& before, const Pixel& pixel) {
  const DepthOutcome& outcome =
      SilhouetteDepth::function(pixel)[static_cast<std::size_t>(before.state)];
  switch (outcome.depth) {
    case DepthOutcome::Depth::kNone:
      return {outcome.state, -1};
    case DepthOutcome::Depth::kInFront:
      return {outcome.state, before.depth};
    case DepthOutcome::Depth::kInSegment:
      return {outcome.state, pixel.depth};
  }
  return {};
}

/// The same state and, where the state has one, the same depth.
bool agree(const test::Walk& a, const test::Walk& b) {
  const bool hasDepth = a.state == kContour || a.state == kSilhouette;
  return a.state == b.state && (!hasDepth || a.depth == b.depth);
}

TEST(SilhouetteDepth, HasEightFunctionsFourOfThemWithADepth) {
  EXPECT_EQ(SilhouetteDepth::kFunctions, 8u);
  EXPECT_EQ(std::ranges::count_if(everyPixel(1), SilhouetteDepth::hasDepth), 4);
}

TEST(SilhouetteDepth, IsAssociativeForAllTriplesWhateverTheDepths) {
  for (const Pixel& f : everyPixel(1)) {
    for (const Pixel& m : everyPixel(2)) {
      for (const Pixel& b : everyPixel(3)) {
        EXPECT_EQ(SilhouetteDepth::combine(SilhouetteDepth::combine(f, m), b),
                  SilhouetteDepth::combine(f, SilhouetteDepth::combine(m, b)));
      }
    }
  }
}

TEST(SilhouetteDepth, SegmentDoesWhatTheStateMachineDoesFromEveryState) {
  for (int length = 0; length <= 8; ++length) {
    test::forEachRay(length, [](const DeepSlices& slices) {
      const Pixel pixel = deepSegment(slices, 10);
      for (const RayState state : {kEmpty, kFilled, kContour, kSilhouette}) {
        const test::Walk before{state, 5};
        ASSERT_TRUE(agree(walkAfter(before, pixel), test::walk(before, slices, 10)));
      }
    });
  }
}

TEST(SilhouetteDepth, RanksTogetherSeeWhatOneSees) {
  test::Random random{1};
  for (int trial = 0; trial < 20'000; ++trial) {
    DeepSlices ray;
    std::vector<Pixel> ranks;
    for (int rank = 0; rank < 6; ++rank) {
      DeepSlices part(random() % 4);
      for (SliceSymbol& symbol : part) symbol = test::randomSymbol(random);
      ranks.push_back(deepSegment(part, static_cast<float>(ray.size())));
      ray.insert(ray.end(), part.begin(), part.end());
    }
    ray.push_back(SliceSymbol::kEmpty);
    const Pixel all = test::combineAtRandom<SilhouetteDepth>(ranks, random);
    const test::Walk whole = test::walk({}, ray, 0);
    ASSERT_TRUE(agree({SilhouetteDepth::finalState(all), all.depth}, whole));
  }
}

TEST(SilhouetteDepth, WithoutDepthsItIsSilhouette) {
  for (int length = 0; length <= 8; ++length) {
    test::forEachRay(length, [](const DeepSlices& slices) {
      const Pixel pixel = deepSegment(slices, 0);
      SilhouetteCode code{};
      for (const SliceSymbol symbol : slices) {
        code = Silhouette::combine(code, Silhouette::slice(symbol));
      }
      ASSERT_EQ(SilhouetteDepth::finalState(pixel), Silhouette::finalState(code));
      ASSERT_EQ(SilhouetteDepth::canStop(pixel), Silhouette::canStop(code));
    });
  }
}

TEST(SilhouetteDepth, StopsExactlyWhenNothingBehindMatters) {
  for (const Pixel& front : everyPixel(1)) {
    bool isChanged = false;
    for (const Pixel& back : everyPixel(2)) {
      isChanged |= SilhouetteDepth::combine(front, back) != front;
    }
    EXPECT_EQ(SilhouetteDepth::canStop(front), !isChanged);
  }
}

TEST(SilhouetteDepth, DepthTravelsOnlyWhereThereIsOneAndMustBeANumber) {
  for (const Pixel& pixel : everyPixel(0.5f)) {
    std::array<std::byte, SilhouetteDepth::kMaxWireBytes> bytes{};
    const std::size_t length = SilhouetteDepth::store(pixel, bytes);
    EXPECT_EQ(length, SilhouetteDepth::hasDepth(pixel) ? 5u : 1u);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(&bytes[1], &nan, sizeof(nan));
    Pixel into;
    EXPECT_EQ(SilhouetteDepth::load(bytes, into), SilhouetteDepth::hasDepth(pixel) ? 0u : 1u);
  }
}

TEST(SilhouetteDepth, UnknownCodesAreDamaged) {
  std::array<std::byte, SilhouetteDepth::kMaxWireBytes> bytes{};
  for (unsigned code = 0; code < 256; ++code) {
    bytes[0] = static_cast<std::byte>(code);
    Pixel into;
    EXPECT_EQ(SilhouetteDepth::load(bytes, into) != 0, code < 8);
  }
}

}  // namespace
}  // namespace burin::compositor
