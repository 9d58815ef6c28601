#include "burin/common/transfer_function.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace burin {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Colour kBlack{0, 0, 0};
constexpr Colour kWhite{255, 255, 255};

TEST(Extinction, IsBeerLambertsInverse) {
  for (const double opacity : {0.0, 1e-12, 1e-6, 0.25, 0.5, 0.9, 0.9999}) {
    for (const double length : {1e-20, 0.5, 3.0, 1e20}) {
      const double sigma = extinctionFromOpacity(opacity, length);
      // log1p, expm1, a division and a product: a few ulp of the exponent, which is at most 9.2, so
      // of the opacity relatively at most 9.2 · 4u.
      EXPECT_NEAR(-std::expm1(-sigma * length), opacity, opacity * 40 * 0x1p-53);
    }
  }
}

TEST(Extinction, StaysFiniteForOpaqueMaterial) {
  EXPECT_DOUBLE_EQ(extinctionFromOpacity(1, 2), -std::log(1 - kLargestOpacity) / 2);
  EXPECT_EQ(extinctionFromOpacity(1, 2), extinctionFromOpacity(kLargestOpacity, 2));
}

TEST(TransferFunction, LinearInColourAndOpacity) {
  const TransferFunction f{{{10, kBlack, 0.2}, {20, kWhite, 0.6}}, {}};
  const Classified quarter = f.classify(12.5, 2);
  EXPECT_DOUBLE_EQ(quarter.colour.r, 0.25);  // linear light: a quarter of white's, not of its code
  EXPECT_DOUBLE_EQ(quarter.extinction, -std::log(1 - 0.3) / 2);
}

TEST(TransferFunction, EndsHoldOutside) {
  const TransferFunction f{{{10, kBlack, 0.2}, {20, kWhite, 0.6}}, {}};
  EXPECT_EQ(f.classify(-kInfinity, 1).extinction, extinctionFromOpacity(0.2, 1));
  EXPECT_EQ(f.classify(10, 1).colour.r, 0);
  EXPECT_EQ(f.classify(20, 1).colour.r, 1);
  EXPECT_EQ(f.classify(kInfinity, 1).extinction, extinctionFromOpacity(0.6, 1));
}

TEST(TransferFunction, OnePointIsConstant) {
  const TransferFunction f{{{5, kWhite, 0.5}}, {}};
  for (const double value : {-1e300, 5.0, 1e300}) {
    EXPECT_DOUBLE_EQ(f.classify(value, 1).extinction, std::log(2));
  }
}

TEST(TransferFunction, StepTakesTheLaterPoint) {
  const TransferFunction f{{{0, kBlack, 0.1}, {1, kBlack, 0.1}, {1, kWhite, 0.8}, {2, kWhite, 0.8}},
                           {}};
  EXPECT_DOUBLE_EQ(f.classify(std::nextafter(1, 0), 1).extinction, -std::log(0.9));
  EXPECT_DOUBLE_EQ(f.classify(1, 1).extinction, -std::log(0.2));
  EXPECT_EQ(f.classify(1, 1).colour.g, 1);
}

TEST(TransferFunction, StepAtAnEnd) {
  const TransferFunction front{{{1, kBlack, 0.1}, {1, kBlack, 0.8}, {2, kBlack, 0.8}}, {}};
  EXPECT_DOUBLE_EQ(front.classify(0.5, 1).extinction, -std::log(0.9));
  EXPECT_DOUBLE_EQ(front.classify(1, 1).extinction, -std::log(0.2));
  const TransferFunction back{{{0, kBlack, 0.1}, {1, kBlack, 0.1}, {1, kBlack, 0.8}}, {}};
  EXPECT_DOUBLE_EQ(back.classify(std::nextafter(1, 0), 1).extinction, -std::log(0.9));
  EXPECT_DOUBLE_EQ(back.classify(7, 1).extinction, -std::log(0.2));
}

TEST(TransferFunction, ScaleOfTheDataDoesNotMatter) {
  for (const double scale : {1e-300, 1e-20, 1.0, 1e20, 1e308}) {
    const TransferFunction f{{{-scale, kBlack, 0}, {scale, kWhite, 0.8}}, {}};
    EXPECT_DOUBLE_EQ(f.classify(0, 1).extinction, -std::log(0.6)) << scale;
    EXPECT_DOUBLE_EQ(f.classify(scale / 2, 1).colour.r, 0.75) << scale;
  }
}

TEST(LargestExtinction, OfAnIntervalWithoutValuesIsZero) {
  const TransferFunction f{{{0, kWhite, 0.5}}, {}};
  EXPECT_EQ(f.largestExtinction(kInfinity, -kInfinity, 1), 0);
  EXPECT_EQ(f.largestExtinction(std::nan(""), std::nan(""), 1), 0);
}

TEST(LargestExtinction, StepCountsFromTheSideTheIntervalReaches) {
  const TransferFunction falls{{{0, kBlack, 0.8}, {1, kBlack, 0.8}, {1, kBlack, 0}, {2, kBlack, 0}},
                               {}};
  EXPECT_EQ(falls.largestExtinction(1, 2, 1), 0);
  EXPECT_EQ(falls.largestExtinction(0.5, 1, 1), extinctionFromOpacity(0.8, 1));
  const TransferFunction rises{{{0, kBlack, 0}, {1, kBlack, 0}, {1, kBlack, 0.8}, {2, kBlack, 0}},
                               {}};
  EXPECT_EQ(rises.largestExtinction(0, std::nextafter(1, 0), 1), 0);
  EXPECT_EQ(rises.largestExtinction(0, 1, 1), extinctionFromOpacity(0.8, 1));
}

TEST(LargestExtinction, AgreesWithBruteForce) {
  std::mt19937 random{20250301};
  std::uniform_int_distribution<int> grid{0, 12};  // coarse, so that steps and equal ends happen
  std::uniform_real_distribution<double> unit{0, 1};
  for (int round = 0; round < 300; ++round) {
    std::vector<int> values(static_cast<std::size_t>(1 + round % 6));
    for (int& v : values) v = grid(random);
    std::sort(values.begin(), values.end());
    TransferFunction f;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i >= 2 && values[i] == values[i - 2]) continue;  // at most two make a step
      f.points.push_back({static_cast<double>(values[i]), kWhite, unit(random)});
    }
    const int a = grid(random), b = grid(random);
    const double lo = std::min(a, b), hi = std::max(a, b);
    // Every integer and both its neighbours inside [lo, hi]: all corners of the piecewise linear
    // curve and the limits at its steps (off by 1e-15 of the step's neighbouring slope).
    double largest = 0;
    for (double v = lo; v <= hi; v += 1) {
      for (const double x : {std::nextafter(v, -kInfinity), v, std::nextafter(v, kInfinity)}) {
        if (x >= lo && x <= hi) largest = std::max(largest, f.classify(x, 0.7).extinction);
      }
    }
    // Extinction grows with opacity by 1/(1-o)/0.7 ≤ 1.5e4; opacity there is off by 13u at most.
    EXPECT_NEAR(f.largestExtinction(lo, hi, 0.7), largest, 1.5e4 * 13 * 0x1p-52);
  }
}

}  // namespace
}  // namespace burin
