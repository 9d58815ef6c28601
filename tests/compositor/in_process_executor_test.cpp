#include "burin/compositor/in_process_executor.hpp"

#include <gtest/gtest.h>

#include "test_images.hpp"

namespace burin::compositor {
namespace {

using test::Affine;

template <PixelAlgebra A>
Image<typename A::Pixel> composed(ScheduleKind kind, ImageSize frame,
                                  const std::vector<Subimage<typename A::Pixel>>& images) {
  const PixelRect bounds = test::boundsOf(images);
  const auto schedule = makeSchedule(kind, static_cast<int>(images.size()), {0, bounds.pixels()});
  return assemble(executeInProcess<A>(schedule, bounds, images), frame);
}

class InProcess : public testing::TestWithParam<ScheduleKind> {};

TEST_P(InProcess, EqualsSerialCombinationExactlyForAnyCountAndSize) {
  for (const ImageSize frame :
       {ImageSize{1, 1}, ImageSize{3, 2}, ImageSize{97, 31}, ImageSize{997, 1}, ImageSize{1, 97}}) {
    for (int n = 1; n <= 17; ++n) {
      for (unsigned seed = 0; seed < 5; ++seed) {
        const auto images = test::randomSubimages<Affine>(frame, n, 100 * seed + 7);
        ASSERT_TRUE(test::areEqual(composed<Affine>(GetParam(), frame, images),
                                   test::combineSerially<Affine>(frame, images)))
            << n << " participants, " << frame.width << "x" << frame.height << ", seed " << seed;
      }
    }
  }
}

TEST_P(InProcess, EqualsSerialCombinationOfALargeFrame) {
  const ImageSize frame{509, 503};
  for (const int n : {2, 3, 5, 8}) {
    const auto images = test::randomSubimages<Affine>(frame, n, 3);
    EXPECT_TRUE(test::areEqual(composed<Affine>(GetParam(), frame, images),
                               test::combineSerially<Affine>(frame, images)))
        << n;
  }
}

TEST_P(InProcess, OverEqualsSerialCombinationToRounding) {
  const ImageSize frame{64, 48};
  for (int n = 1; n <= 17; ++n) {
    const auto images = test::randomSubimages<Over>(frame, n, static_cast<unsigned>(n));
    EXPECT_LE(test::largestDifference(composed<Over>(GetParam(), frame, images),
                                      test::combineSerially<Over>(frame, images)),
              test::overTolerance(n))
        << n;
  }
}

TEST_P(InProcess, NothingDrawnIsAnIdentityFrame) {
  const ImageSize frame{5, 4};
  const std::vector<Subimage<Affine::Pixel>> images(3, {frame, {}, {}});
  const auto image = composed<Affine>(GetParam(), frame, images);
  EXPECT_TRUE(std::ranges::all_of(image.pixels(), Affine::isIdentity));
}

TEST_P(InProcess, FullFramesAreCombinedInOrder) {
  const ImageSize frame{16, 16};
  test::Random random{12};
  std::vector<Subimage<Affine::Pixel>> images;
  for (int i = 0; i < 6; ++i) {
    images.push_back(test::randomSubimage<Affine>(frame, {0, 0, 16, 16}, random));
  }
  const auto inOrder = composed<Affine>(GetParam(), frame, images);
  EXPECT_TRUE(test::areEqual(inOrder, test::combineSerially<Affine>(frame, images)));
  std::swap(images[2], images[3]);
  EXPECT_FALSE(test::areEqual(inOrder, test::combineSerially<Affine>(frame, images)));
}

TEST_P(InProcess, WhatIsSentIsReceived) {
  const auto images = test::randomSubimages<Affine>({97, 31}, 13, 4);
  const PixelRect bounds = test::boundsOf(images);
  const auto schedule = makeSchedule(GetParam(), 13, {0, bounds.pixels()});
  std::int64_t sent = 0;
  std::int64_t received = 0;
  for (const auto& participant : executeInProcess<Affine>(schedule, bounds, images)) {
    sent += participant.traffic().bytesSent;
    received += participant.traffic().bytesReceived;
    EXPECT_FALSE(participant.outcome().failed);
  }
  EXPECT_EQ(sent, received);
  EXPECT_GT(sent, 0);
}

std::string nameOf(const testing::TestParamInfo<ScheduleKind>& kind) {
  return kind.param == ScheduleKind::kBinarySwap ? "BinarySwap" : "DirectSend";
}
INSTANTIATE_TEST_SUITE_P(, InProcess,
                         testing::Values(ScheduleKind::kBinarySwap, ScheduleKind::kDirectSend),
                         nameOf);

}  // namespace
}  // namespace burin::compositor
