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

TEST(TransferWidget, TrianglesStandOnTheirApex) {
  const TransferWidget t{
      .shape = WidgetShape::kTriangle, .value = {10, 30}, .gradient = {0.1, 0.9}};
  // Half way up, between 15 and 25, falling from the middle to the edges.
  EXPECT_DOUBLE_EQ(t.weight(20, 0.45), 1);
  EXPECT_DOUBLE_EQ(t.weight(17.5, 0.45), 0.5);
  EXPECT_DOUBLE_EQ(t.weight(24, 0.45), 0.2);
  EXPECT_EQ(t.weight(14.9, 0.45), 0);
  // A quarter of half of 0.8 from either end of m.
  EXPECT_DOUBLE_EQ(t.weight(20, 0.15), 0.5);
  EXPECT_DOUBLE_EQ(t.weight(20, 0.85), 0.5);
  EXPECT_EQ(t.weight(20, 0.1), 0);
  EXPECT_EQ(t.weight(20, 0.95), 0);
  TransferWidget leaning = t;
  leaning.apex = 0;
  leaning.gradient = {0, 1};
  EXPECT_DOUBLE_EQ(leaning.weight(10, 0.5), 1);  // between 5 and 15
  EXPECT_DOUBLE_EQ(leaning.weight(20, 1), 1);    // no edge at 1
  EXPECT_EQ(leaning.weight(0, 0), 0);            // but at 0
  EXPECT_EQ(leaning.valueRange(), (glm::dvec2{0, 30}));
}

TEST(TransferWidget, RectanglesGoOnBeyondZeroAndOne) {
  TransferWidget r{.value = {10, 30}, .gradient = {0, 1}, .valueFalloff = 0.5};
  for (const double m : {0.0, 0.5, 1.0}) {
    EXPECT_DOUBLE_EQ(r.weight(16, m), 1);
    EXPECT_DOUBLE_EQ(r.weight(12, m), 0.4);
    EXPECT_EQ(r.weight(31, m), 0);
  }
  r.gradient = {0.2, 0.6};
  EXPECT_EQ(r.weight(20, 0), 0);
  EXPECT_DOUBLE_EQ(r.weight(20, 0.225), 0.5);
  EXPECT_DOUBLE_EQ(r.weight(20, 0.575), 0.5);
  EXPECT_EQ(r.weight(20, 1), 0);
}

TEST(TransferWidget, EllipsesFallOffSmoothly) {
  const TransferWidget e{
      .shape = WidgetShape::kEllipse, .value = {10, 30}, .gradient = {-0.4, 0.4}};
  EXPECT_DOUBLE_EQ(e.weight(20, 0), 1);
  EXPECT_DOUBLE_EQ(e.weight(25, 0), 0.75 * 0.75);
  EXPECT_DOUBLE_EQ(e.weight(25, 0.2), 0.25);
  EXPECT_EQ(e.weight(30, 0), 0);
  EXPECT_EQ(e.weight(20, 0.5), 0);
  // u² = 1 - 0.75² at the edges.
  EXPECT_NEAR(e.edgesAt(0.3).y, 20 + 10 * std::sqrt(1 - 0.5625), 1e-13);
}

TEST(TransferFunction, WidgetsAreSimultaneousMedia) {
  TransferFunction f;
  f.widgets = {{.value = {0, 10}, .colour = kWhite, .opacity = 0.5},
               {.value = {4, 20}, .colour = kBlack, .opacity = 0.75}};
  EXPECT_DOUBLE_EQ(f.classify(2, 0.5, 2).extinction, std::log(2) / 2);
  const Classified both = f.classify(7, 0.5, 2);
  EXPECT_DOUBLE_EQ(both.extinction, (std::log(2) + std::log(4)) / 2);
  EXPECT_DOUBLE_EQ(both.colour.r, 1.0 / 3);
  EXPECT_EQ(f.classify(-1, 0.5, 2).extinction, 0);
}

TEST(TransferFunction, AnEnvelopeIsAboveZeroWhereWidgetsMayShow) {
  TransferFunction f;
  f.widgets = {{.value = {5, 6}, .opacity = 0.5},
               {.shape = WidgetShape::kTriangle, .value = {1, 2}, .apex = 3, .opacity = 0.1},
               {.value = {5.5, 8}, .opacity = 0.2},
               {.value = {9, 10}, .opacity = 0}};
  const TransferFunction e = f.envelope();
  for (const double value : {1.0, 1.5, 2.99, 5.0, 7.99}) {
    EXPECT_GT(e.classify(value, 1).extinction, 0) << value;
  }
  for (const double value : {-1.0, 0.99, 3.01, 4.99, 8.01, 9.5}) {
    EXPECT_EQ(e.classify(value, 1).extinction, 0) << value;
  }
  EXPECT_EQ(f.largestExtinction(3.5, 4.5, 1), 0);
  EXPECT_GT(f.largestExtinction(2.5, 4.5, 1), 0);
  f.widgets.resize(1);
  f.widgets[0].opacity = 0;
  EXPECT_EQ(f.largestExtinction(-kInfinity, kInfinity, 1), 0);
}

}  // namespace
}  // namespace burin
