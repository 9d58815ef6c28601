#include "burin/compositor/partial_image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "burin/common/error.hpp"
#include "burin/compositor/participant.hpp"
#include "test_images.hpp"

namespace burin::compositor {
namespace {

using test::Affine;
using test::Random;
using testing::HasSubstr;

constexpr ImageSize kFrame{13, 11};
constexpr PixelRect kBounds{0, 0, 13, 11};
constexpr Region kAll{0, 13 * 11};

Image<Affine::Pixel> pasted(const PartialImage<Affine>& image) {
  Image<Affine::Pixel> frame{kFrame};
  std::ranges::fill(frame.pixels(), Affine::identity());
  image.pasteInto(frame);
  return frame;
}

/// Identity outside the region.
Image<Affine::Pixel> cut(Image<Affine::Pixel> frame, const Region& region) {
  for (std::size_t i = 0; i < frame.pixels().size(); ++i) {
    if (i < region.begin || i >= region.end) frame.pixels()[i] = Affine::identity();
  }
  return frame;
}

Region randomRegion(Random& random) {
  const std::size_t a = random() % (kAll.end + 1);
  const std::size_t b = random() % (kAll.end + 1);
  return {std::min(a, b), std::max(a, b)};
}

TEST(PartialImage, NarrowAndCombineEqualWholeFrames) {
  Random random{7};
  for (int trial = 0; trial < 3000; ++trial) {
    const auto images = test::randomSubimages<Affine>(kFrame, 2, static_cast<unsigned>(trial));
    const Region region = randomRegion(random);
    const bool secondIsInFront = trial % 2 == 1;
    PartialImage<Affine> first{kBounds, images[0]};
    const PartialImage<Affine> second{kBounds, images[1]};
    const MessageBuffer message = second.encode(region);
    first.narrow(region);
    first.combine(message.bytes(), secondIsInFront);
    const auto inOrder = secondIsInFront ? std::vector{images[1], images[0]} : images;
    ASSERT_TRUE(
        test::areEqual(pasted(first), cut(test::combineSerially<Affine>(kFrame, inOrder), region)));
  }
}

TEST(PartialImage, MessageHasOnlyActivePixelsOfTheRegion) {
  Random random{8};
  for (int trial = 0; trial < 1000; ++trial) {
    const auto image =
        test::randomSubimage<Affine>(kFrame, test::randomRect(kFrame, random), random);
    const Region region = randomRegion(random);
    std::size_t active = 0;
    for (std::size_t i = region.begin; i < region.end; ++i) {
      const int x = static_cast<int>(i % 13);
      const int y = static_cast<int>(i / 13);
      const PixelRect& r = image.active;
      if (x >= r.x0 && x < r.x1 && y >= r.y0 && y < r.y1) ++active;
    }
    const PartialImage<Affine> partial{kBounds, image};
    ASSERT_EQ(partial.encode(region).bytes().size(), kShareHeaderBytes + 8 * active);
  }
}

TEST(PartialImage, PastedMessageEqualsTheImage) {
  Random random{9};
  for (int trial = 0; trial < 500; ++trial) {
    const auto image =
        test::randomSubimage<Affine>(kFrame, test::randomRect(kFrame, random), random);
    const Region region = randomRegion(random);
    const PartialImage<Affine> partial{kBounds, image};
    Image<Affine::Pixel> frame{kFrame};
    std::ranges::fill(frame.pixels(), Affine::identity());
    pasteMessage<Affine>(partial.encode(region).bytes(), kBounds, region, frame);
    ASSERT_TRUE(test::areEqual(frame, cut(test::combineSerially<Affine>(kFrame, {image}), region)));
  }
}

std::vector<std::byte> copyOf(std::span<const std::byte> bytes) {
  return {bytes.begin(), bytes.end()};
}

class DamagedMessage : public testing::Test {
 protected:
  DamagedMessage() {
    Random random{10};
    const PartialImage<Affine> sender{kBounds,
                                      test::randomSubimage<Affine>(kFrame, {2, 3, 9, 8}, random)};
    message_ = copyOf(sender.encode(kAll).bytes());
    own_ = test::randomSubimage<Affine>(kFrame, {1, 1, 4, 5}, random);
  }

  /// What combine says of the bytes; "" if it takes them.
  std::string complaint(std::span<const std::byte> bytes, const Region& region = kAll) {
    PartialImage<Affine> image{kBounds, own_};
    image.narrow(region);
    const auto before = pasted(image);
    try {
      image.combine(bytes, true);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ExitCode::kRank);
      EXPECT_TRUE(test::areEqual(pasted(image), before));
      return e.what();
    }
    return "";
  }

  template <typename T>
  void overwrite(std::size_t offset, T value) {
    std::memcpy(message_.data() + offset, &value, sizeof value);
  }

  std::vector<std::byte> message_;
  Subimage<Affine::Pixel> own_;
};

TEST_F(DamagedMessage, UndamagedIsTaken) {
  EXPECT_EQ(complaint(message_), "");
}

TEST_F(DamagedMessage, AnyTruncationIsRefused) {
  for (std::size_t size = 0; size < message_.size(); ++size) {
    // A copy of just that size, so that a sanitizer sees any over-read.
    const auto shorter = copyOf(std::span{message_}.first(size));
    EXPECT_THAT(complaint(shorter), HasSubstr("bytes expected")) << size;
  }
}

TEST_F(DamagedMessage, TrailingBytesAreRefused) {
  message_.push_back(std::byte{0});
  EXPECT_THAT(complaint(message_), HasSubstr("320 bytes expected, 321 received"));
}

TEST_F(DamagedMessage, EachFieldIsChecked) {
  const auto intact = message_;
  overwrite(0, std::uint32_t{0});
  EXPECT_THAT(complaint(message_), HasSubstr("not a compositing message"));
  message_ = intact;
  overwrite(20, std::uint32_t{16});
  EXPECT_THAT(complaint(message_), HasSubstr("pixels of 8 bytes expected, of 16 received"));
  message_ = intact;
  overwrite(24, std::uint64_t{1});
  EXPECT_THAT(complaint(message_), HasSubstr("region [0,143) expected, [1,143) received"));
  message_ = intact;
  overwrite(12, std::int32_t{14});  // x1, one beyond the bounds
  EXPECT_THAT(complaint(message_), HasSubstr("out of bounds"));
  overwrite(4, std::int32_t{-2'000'000'000});
  overwrite(12, std::int32_t{2'000'000'000});  // a width that overflows int
  EXPECT_THAT(complaint(message_), HasSubstr("out of bounds"));
  message_ = intact;
  overwrite(12, std::int32_t{8});  // a rectangle too small for the pixels that follow
  EXPECT_THAT(complaint(message_), HasSubstr("bytes expected"));
  message_ = intact;
  overwrite(12, std::int32_t{-7});  // an inverted rectangle, which has no pixels
  EXPECT_THAT(complaint(message_), HasSubstr("40 bytes expected"));
}

TEST_F(DamagedMessage, OfAnotherRegionIsRefused) {
  EXPECT_THAT(complaint(message_, {0, 70}), HasSubstr("region [0,70) expected"));
}

TEST_F(DamagedMessage, RandomHeadersNeverCrash) {
  Random random{11};
  int taken = 0;
  for (int trial = 0; trial < 20'000; ++trial) {
    auto damaged = message_;
    for (int i = 0; i < 2; ++i) {
      damaged[random() % kShareHeaderBytes] = static_cast<std::byte>(random());
    }
    if (complaint(damaged).empty()) ++taken;
  }
  EXPECT_LT(taken, 2000);  // a byte replaced by itself, or a rectangle of as many pixels
}

TEST_F(DamagedMessage, ParticipantGoesOnEmptyHandedAndSaysWhoSentIt) {
  Participant<Affine> participant{kBounds, own_};
  message_.pop_back();
  participant.receive({Step::Kind::kReceive, 3, kAll, true}, Rank{5}, message_);
  EXPECT_TRUE(participant.outcome().failed);
  EXPECT_EQ(participant.outcome().reason, "message from rank 5: 320 bytes expected, 319 received");
  EXPECT_EQ(participant.encode({0, 70}).bytes().size(), kShareHeaderBytes);
  EXPECT_EQ(participant.traffic().bytesReceived, 319);
  EXPECT_EQ(participant.traffic().messagesSent, 1);
}

}  // namespace
}  // namespace burin::compositor
