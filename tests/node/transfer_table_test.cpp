#include "transfer_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace burin::node {
namespace {

/// Linear look-up in double: what the texture unit does, without its rounding.
double extinctionAt(const TransferTable& table, double value) {
  const double position = std::clamp((value - table.first) / table.binWidth(), 0.0,
                                     static_cast<double>(table.entries.size() - 1));
  const auto bin = std::min(static_cast<std::size_t>(position), table.entries.size() - 2);
  const double part = position - static_cast<double>(bin);
  return (1 - part) * double{table.entries[bin].a} + part * double{table.entries[bin + 1].a};
}

double largestOpacityError(const TransferFunction& function, double unit, double from, double to) {
  const TransferTable table = makeTransferTable(function, unit, from, to);
  double worst = 0;
  for (int i = 0; i <= 40000; ++i) {
    const double value = from + (to - from) * i / 40000.0;
    worst = std::max(worst, std::abs(std::exp(-unit * extinctionAt(table, value)) -
                                     std::exp(-unit * function.classify(value, unit).extinction)));
  }
  return worst;
}

TEST(TransferTable, MeetsPointsOnACommonGridExactly) {
  const TransferFunction function{
      {{30, {}, 0}, {60, {}, 0.3}, {84, {}, 0.22}, {96, {}, 0}, {200, {}, 0.5}}, {}};
  EXPECT_LE(largestOpacityError(function, 0.5, 0, 255), 2e-6);  // 1e-6 asked for at the middles
  const TransferTable table = makeTransferTable(function, 0.5, 0, 255);
  for (const TransferPoint& point : function.points)
    EXPECT_FLOAT_EQ(static_cast<float>(extinctionAt(table, point.value)),
                    static_cast<float>(extinctionFromOpacity(point.opacity, 0.5)));
}

TEST(TransferTable, PointsWithoutCommonGridStayWithinABin) {
  const TransferFunction function{
      {{0, {}, 0}, {std::sqrt(0.1), {}, 0}, {std::sqrt(0.2), {}, 0.8}, {1, {}, 0.1}}, {}};
  // A kink inside a bin of 1/16383 is cut: slope change 6 opacity per range, a quarter bin at most.
  EXPECT_LE(largestOpacityError(function, 1, 0, 1), 6.0 / 4 / 16383);
}

TEST(TransferTable, PointsFarOutsideTheDataTakeNoBinsAway) {
  const TransferFunction far{{{-1e6, {}, 0}, {0.2, {}, 0.1}, {0.77, {}, 0.4}, {1e6, {}, 0.2}}, {}};
  EXPECT_LE(largestOpacityError(far, 1, 0, 1), 2e-6);
  const TransferFunction high{{{0, {}, 0}, {0.2, {}, 0}, {0.77, {}, 0.3}, {3000, {}, 0.9}}, {}};
  EXPECT_LE(largestOpacityError(high, 1, 0, 1), 2e-6);
  const TransferFunction across{{{-50, {}, 0.1}, {90, {}, 0.8}}, {}};  // no point in the data
  EXPECT_LE(largestOpacityError(across, 1, 0, 1), 2e-6);
  const TransferFunction beyond{{{5, {}, 0.1}, {9, {}, 0.8}}, {}};
  EXPECT_LE(largestOpacityError(beyond, 1, 0, 1), 2e-6);
  const TransferFunction oneInside{{{-9, {}, 0}, {0.3141, {}, 0.6}, {7, {}, 0}}, {}};
  EXPECT_LE(largestOpacityError(oneInside, 1, 0, 1), 2e-6);
}

TEST(TransferTable, NearlyOpaqueRampsStayFinite) {
  const TransferFunction function{{{0, {}, 0}, {1, {}, 1}}, {}};
  const TransferTable table = makeTransferTable(function, 1, 0, 1);
  EXPECT_FLOAT_EQ(table.entries.back().a, static_cast<float>(-std::log(1 - kLargestOpacity)));
  // In the last bin the opacity runs from 1 - 1/16384 to its cut at 0.9999: nothing in it can be
  // off by more than the transparency at its start, 1/16384 + 1e-4.
  EXPECT_LE(largestOpacityError(function, 1, 0, 1), 1.0 / 16384 + 1e-4);
}

TEST(TransferTable, ConstantAndStepFunctions) {
  const TransferFunction constant{{{5, {}, 0.25}}, {}};
  EXPECT_LE(largestOpacityError(constant, 1, 0, 10), 1e-7);
  const TransferFunction step{{{5, {}, 0.1}, {5, {}, 0.7}}, {}};
  const TransferTable table = makeTransferTable(step, 1, 0, 10);
  EXPECT_NEAR(extinctionAt(table, 4.99), extinctionFromOpacity(0.1, 1), 1e-6);
  EXPECT_NEAR(extinctionAt(table, 5.01), extinctionFromOpacity(0.7, 1), 1e-6);
}

}  // namespace
}  // namespace burin::node
