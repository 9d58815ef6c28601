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

TEST(TransferTable, AStepAtTheFirstPointHasItsFootInTheTable) {
  const TransferFunction step{{{4, {}, 0.1}, {4, {}, 0.7}, {9, {}, 0}}, {}};
  const TransferTable table = makeTransferTable(step, 1, 0, 10);
  EXPECT_NEAR(extinctionAt(table, 4 - 1.01 * table.binWidth()), extinctionFromOpacity(0.1, 1),
              1e-6);
  EXPECT_NEAR(extinctionAt(table, 4), extinctionFromOpacity(0.7, 1), 1e-6);
}

/// Of the rows, between the table's ends, in units of value.
glm::dvec4 integralOfRows(const TransferTable& table) {
  const TransferRows rows = transferRows(table);
  EXPECT_EQ(rows.extinction.size(), table.entries.size() + 1);
  const glm::vec4 end = rows.extinction.back();
  return table.binWidth() *
         glm::dvec4{glm::dvec3{rows.colour.back()}, double{end.x} + double{end.y}};
}

TEST(TransferTable, RowsMissNothing) {
  // Two spikes, each narrower than a bin, without common grid: the integral of -ln(1 - o) over a
  // triangle of height o and half width w is 2 w ((1 - o) ln(1 - o) + o) / o.
  const double second = 0.1 * std::sqrt(50);
  const auto function = [&](double w) {
    return TransferFunction{{{0.2 - w, {}, 0},
                             {0.2, {255, 255, 255}, 0.9},
                             {0.2 + w, {}, 0},
                             {second - w, {}, 0},
                             {second, {255, 255, 255}, 0.9},
                             {second + w, {}, 0}},
                            {}};
  };
  for (const double w : {1e-2, 1e-4, 1e-5, 1e-7}) {
    const double expected = 2 * 2 * w * (0.1 * std::log(0.1) + 0.9) / 0.9;
    const glm::dvec4 rows = integralOfRows(makeTransferTable(function(w), 1, 0, 1));
    EXPECT_NEAR(rows.a / expected, 1, 1e-9) << w;
    // White at the peak, where extinction is: with q = 1 - opacity the colour is (1 - q) / 0.9, the
    // integral over the same ((q²/4 - q²/2 ln q) at 1 - at 0.1), which is 0.25 - 0.0140129.
    const double first = 0.1 * std::log(0.1) + 0.9;
    const double colour = 4 * w * (first - (0.2475 + 0.005 * std::log(0.1))) / (0.9 * 0.9);
    EXPECT_NEAR(rows.r / colour, 1, 1e-6) << w;
  }
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
