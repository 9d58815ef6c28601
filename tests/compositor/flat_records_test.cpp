#include "burin/compositor/flat_records.hpp"

#include <gtest/gtest.h>

#include "slice_rays.hpp"

namespace burin::compositor {
namespace {

constexpr std::size_t kPriorities = 4;
using Flat = FlatRecords<kPriorities>;

struct FlatSample {
  int priority = 0;
  float flatness = 0;
  Rgba colour;
};

/// Some are transparent, and many have the flatness at which nothing or everything is scaled.
FlatSample randomSample(test::Random& random) {
  constexpr std::array kFlatness{0.0f, 1.0f, 0.25f, 0.7f};
  FlatSample sample{test::below(random, int{kPriorities}), kFlatness[random() % kFlatness.size()],
                    test::randomPixel(Over{}, random)};
  if (test::below(random, 5) == 0) sample.colour = {};
  return sample;
}

/// The flat mode as it is defined, sample by sample on one ray, in double.
std::array<double, 4> flatRay(const std::vector<FlatSample>& samples) {
  std::array<double, 4> sum{};
  int highest = -1;
  for (const FlatSample& sample : samples) {
    if (sample.colour.a == 0) continue;
    if (sample.priority > highest) {
      highest = sample.priority;
      for (double& channel : sum) channel *= 1.0 - double{sample.flatness};
    }
    const double through = 1.0 - sum[3];
    const std::array c{sample.colour.r, sample.colour.g, sample.colour.b, sample.colour.a};
    for (std::size_t i = 0; i < 4; ++i) sum[i] += through * double{c[i]};
  }
  return sum;
}

Flat::Pixel segment(const std::vector<FlatSample>& samples) {
  Flat::Pixel pixel = Flat::identity();
  for (const FlatSample& s : samples) {
    const auto priority = static_cast<std::size_t>(s.priority);
    pixel = Flat::combine(pixel, Flat::sample(priority, s.flatness, s.colour));
  }
  return pixel;
}

/// Half of test::overTolerance as one side is exact; a scaling and the rounding of 1 - flatness are
/// no worse than an `over` more.
double tolerance(std::size_t samples) {
  return 0.5 * double{test::overTolerance(static_cast<int>(samples + 2 * kPriorities))};
}

void expectNear(const Rgba& got, const std::array<double, 4>& exact, double bound) {
  EXPECT_NEAR(double{got.r}, exact[0], bound);
  EXPECT_NEAR(double{got.g}, exact[1], bound);
  EXPECT_NEAR(double{got.b}, exact[2], bound);
  EXPECT_NEAR(double{got.a}, exact[3], bound);
}

TEST(FlatRecords, RanksTogetherDrawWhatOneDraws) {
  test::Random random{1};
  for (int trial = 0; trial < 20'000; ++trial) {
    std::vector<FlatSample> ray;
    std::vector<Flat::Pixel> ranks;
    for (int rank = 0; rank < 6; ++rank) {
      std::vector<FlatSample> part(random() % 6);
      for (FlatSample& sample : part) sample = randomSample(random);
      ray.insert(ray.end(), part.begin(), part.end());
      ranks.push_back(segment(part));
    }
    const Flat::Pixel all = test::combineAtRandom<Flat>(ranks, random);
    expectNear(Flat::flatten(all), flatRay(ray), tolerance(ray.size()));
    if (HasFailure()) FAIL() << "trial " << trial;
  }
}

TEST(FlatRecords, WithoutFlatnessItIsOver) {
  test::Random random{2};
  for (int trial = 0; trial < 1000; ++trial) {
    Rgba sum;
    std::vector<FlatSample> ray(1 + random() % 20);
    for (FlatSample& sample : ray) {
      sample = randomSample(random);
      sample.flatness = 0;
      sum = over(sum, sample.colour);
    }
    EXPECT_LE(test::largestDifference(Flat::flatten(segment(ray)), sum),
              test::overTolerance(static_cast<int>(ray.size())));
  }
}

TEST(FlatRecords, FlatSampleOfHigherPriorityWipesWhatIsInFront) {
  const auto low = Flat::sample(0, 0, {0.9f, 0, 0, 0.9f});
  const auto high = Flat::sample(2, 1, {0, 0, 0.5f, 0.5f});
  EXPECT_EQ(Flat::flatten(Flat::combine(low, high)), (Rgba{0, 0, 0.5f, 0.5f}));
  EXPECT_EQ(Flat::flatten(Flat::combine(high, low)), over({0, 0, 0.5f, 0.5f}, {0.9f, 0, 0, 0.9f}));
}

TEST(FlatRecords, SecondSampleOfAPriorityScalesNothing) {
  const auto pixel = segment({{1, 1, {0.5f, 0, 0, 0.5f}}, {1, 1, {0, 0.5f, 0, 0.5f}}});
  EXPECT_EQ(Flat::flatten(pixel), (Rgba{0.5f, 0.25f, 0, 0.75f}));
}

TEST(FlatRecords, TransparentSampleIsNothing) {
  EXPECT_TRUE(Flat::isIdentity(Flat::sample(3, 1, {})));
  EXPECT_ANY_THROW(Flat::sample(kPriorities, 1, {}));
}

TEST(FlatRecords, WireHoldsTheUsedRecords) {
  std::array<std::byte, Flat::kMaxWireBytes> bytes{};
  EXPECT_EQ(Flat::store(Flat::identity(), bytes), 1u);
  EXPECT_EQ(Flat::store(segment({{0, 0, {1, 1, 1, 1}}, {3, 0, {1, 1, 1, 1}}}), bytes), 41u);
  EXPECT_EQ(FlatRecords<8>::kMinWireBytes, 1u);
  EXPECT_EQ(FlatRecords<9>::kMinWireBytes, 2u);
  EXPECT_EQ(FlatRecords<32>::kMaxWireBytes, 4u + 32u * 20u);
}

TEST(FlatRecords, UnknownPriorityOrNotANumberIsDamaged) {
  std::array<std::byte, Flat::kMaxWireBytes> bytes{};
  Flat::Pixel into;
  for (unsigned mask = 0; mask < 256; ++mask) {
    bytes[0] = static_cast<std::byte>(mask);
    EXPECT_EQ(Flat::load(bytes, into) != 0, mask < 16);
  }
  const auto pixel = segment({{0, 0.5f, {1, 1, 1, 1}}, {3, 0.5f, {1, 1, 1, 1}}});
  const std::size_t length = Flat::store(pixel, bytes);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t at = 1; at < length; at += sizeof(float)) {
    auto damaged = bytes;
    std::memcpy(&damaged[at], &nan, sizeof(nan));
    EXPECT_EQ(Flat::load(damaged, into), 0u) << at;
  }
  EXPECT_EQ(Flat::load(bytes, into), length);
}

}  // namespace
}  // namespace burin::compositor
