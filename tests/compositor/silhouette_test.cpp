#include "burin/compositor/silhouette.hpp"

#include <gtest/gtest.h>

#include <set>

#include "slice_rays.hpp"

namespace burin::compositor {
namespace {

using enum RayState;
using Slices = std::vector<SliceSymbol>;

std::vector<SilhouetteCode> everyCode() {
  std::vector<SilhouetteCode> codes;
  for (unsigned i = 0; i < Silhouette::kFunctions; ++i) codes.push_back(SilhouetteCode(i));
  return codes;
}

SilhouetteCode segment(const Slices& slices) {
  SilhouetteCode code = Silhouette::identity();
  for (const SliceSymbol symbol : slices) {
    code = Silhouette::combine(code, Silhouette::slice(symbol));
  }
  return code;
}

RayState after(RayState before, SilhouetteCode code) {
  return Silhouette::function(code)[static_cast<std::size_t>(before)];
}

TEST(Silhouette, HasTheSevenPairsOfThePaper) {
  std::set<std::pair<RayState, RayState>> pairs;
  for (const SilhouetteCode code : everyCode()) {
    pairs.emplace(after(kEmpty, code), after(kContour, code));
    EXPECT_EQ(after(kFilled, code), kFilled);
    EXPECT_EQ(after(kSilhouette, code), kSilhouette);
  }
  const decltype(pairs) expected{{kEmpty, kContour},       // identity
                                 {kEmpty, kSilhouette},    // one empty slice
                                 {kFilled, kFilled},       // one filled
                                 {kContour, kContour},     // one contour
                                 {kFilled, kSilhouette},   // empty, filled
                                 {kContour, kSilhouette},  // empty, contour
                                 {kSilhouette, kSilhouette}};
  EXPECT_EQ(pairs, expected);
  EXPECT_EQ(Silhouette::kFunctions, 7u);
}

TEST(Silhouette, IsClosedAndAssociativeForAllTriples) {
  for (const SilhouetteCode f : everyCode()) {
    for (const SilhouetteCode m : everyCode()) {
      ASSERT_LT(static_cast<unsigned>(Silhouette::combine(f, m)), Silhouette::kFunctions);
      for (const RayState state : {kEmpty, kFilled, kContour, kSilhouette}) {
        EXPECT_EQ(after(state, Silhouette::combine(f, m)), after(after(state, f), m));
      }
      for (const SilhouetteCode b : everyCode()) {
        EXPECT_EQ(Silhouette::combine(Silhouette::combine(f, m), b),
                  Silhouette::combine(f, Silhouette::combine(m, b)));
      }
    }
  }
}

TEST(Silhouette, SegmentDoesWhatTheStateMachineDoesFromEveryState) {
  for (int length = 0; length <= 8; ++length) {
    test::forEachRay(length, [](const Slices& slices) {
      const SilhouetteCode code = segment(slices);
      for (const RayState before : {kEmpty, kFilled, kContour, kSilhouette}) {
        ASSERT_EQ(after(before, code), test::walk({before}, slices, 0).state);
      }
    });
  }
}

TEST(Silhouette, RanksTogetherSeeWhatOneSees) {
  test::Random random{1};
  for (int trial = 0; trial < 20'000; ++trial) {
    Slices ray;
    std::vector<SilhouetteCode> ranks;
    for (int rank = 0; rank < 6; ++rank) {
      Slices part(random() % 4);
      for (SliceSymbol& symbol : part) symbol = test::randomSymbol(random);
      ray.insert(ray.end(), part.begin(), part.end());
      ranks.push_back(segment(part));
    }
    ray.push_back(SliceSymbol::kEmpty);
    const SilhouetteCode all = test::combineAtRandom<Silhouette>(ranks, random);
    ASSERT_EQ(Silhouette::finalState(all), test::walk({}, ray, 0).state);
  }
}

TEST(Silhouette, RayThatEndsInAContourIsASilhouette) {
  constexpr auto kE = SliceSymbol::kEmpty;
  constexpr auto kF = SliceSymbol::kFilled;
  constexpr auto kC = SliceSymbol::kContour;
  const auto finalState = [](const Slices& slices) {
    return Silhouette::finalState(segment(slices));
  };
  EXPECT_EQ(finalState({}), kEmpty);
  EXPECT_EQ(finalState({kE}), kEmpty);
  EXPECT_EQ(finalState({kF}), kFilled);
  EXPECT_EQ(finalState({kC}), kSilhouette);
  EXPECT_EQ(finalState({kC, kF}), kFilled);
  EXPECT_EQ(finalState({kC, kE, kF}), kSilhouette);
}

TEST(Silhouette, StopsExactlyWhenNothingBehindMatters) {
  for (const SilhouetteCode front : everyCode()) {
    bool isChanged = false;
    for (const SilhouetteCode back : everyCode()) {
      isChanged |= Silhouette::combine(front, back) != front;
    }
    EXPECT_EQ(Silhouette::canStop(front), !isChanged);
  }
}

TEST(Silhouette, SkippedEmptyRunIsOneEmptySliceAndNotTheIdentity) {
  const auto empty = Silhouette::slice(SliceSymbol::kEmpty);
  EXPECT_EQ(Silhouette::combine(empty, empty), empty);
  EXPECT_FALSE(Silhouette::isIdentity(empty));
}

TEST(Silhouette, UnknownCodesAreDamaged) {
  for (unsigned code = 0; code < 256; ++code) {
    const std::array byte{static_cast<std::byte>(code)};
    SilhouetteCode into{};
    EXPECT_EQ(Silhouette::load(byte, into), code < 7 ? 1u : 0u);
  }
}

}  // namespace
}  // namespace burin::compositor
