// The covering array with few ranks and small frames, for the sanitizers.
#include <gtest/gtest.h>

#include "covering_in_process.hpp"

namespace burin::compositor {
namespace {

class CoveringArray : public testing::TestWithParam<test::FrameRow> {};

TEST_P(CoveringArray, EqualsTheSerialCombination) {
  test::expectSerialCombination(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Small, CoveringArray,
    testing::ValuesIn(test::coveringRows(
        {{1, 2, 3, 5, 7, 8, 13}, {{1, 1}, {97, 1}, {997, 1}, {157, 43}, {261, 67}}, 1e9})),
    [](const auto& row) { return test::nameOf(row.param); });

}  // namespace
}  // namespace burin::compositor
